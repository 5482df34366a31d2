// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dhpmap/v1/types.pb.h"
#include "tests/e2e/server_process.h"

namespace dhpmap::testing {

v1::Map GetMap(const ServerProcess& server, const std::string& map);

/// Expects the same submaps with the same voxels in two maps of the server, within what the store's codec loses.
void ExpectSameMaps(const ServerProcess& server, const std::string& a, const std::string& b);

}  // namespace dhpmap::testing
