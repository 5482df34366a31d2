// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap {

/// "dhpmap-evaluate 1.2.3": what --version of a program prints.
std::string VersionOf(const std::string& program);

}  // namespace dhpmap
