// SPDX-License-Identifier: BSD-3-Clause
#include "clients/command_line/version.h"

namespace dhpmap {

std::string VersionOf(const std::string& program) { return program + " " + DHPMAP_VERSION; }

}  // namespace dhpmap
