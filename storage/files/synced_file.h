// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

/// What was written to the file is on the disk. UNAVAILABLE if it cannot be.
Status SyncFile(const std::string& path);

/// Renames a file within its folder, in place of whatever has that name, and syncs the folder. UNAVAILABLE.
Status MoveSynced(const std::string& from, const std::string& to);

}  // namespace dhpmap
