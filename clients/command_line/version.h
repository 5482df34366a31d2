// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap {

/// "dhpmap-evaluate 1.2.3": the output of --version.
std::string VersionOf(const std::string& program);

}  // namespace dhpmap
