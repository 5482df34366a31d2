// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "storage/files/map_copy.h"
#include "storage/store.h"

namespace dhpmap {

/// An import into the database at `path`; the received data lie in a file next to it.
Result<std::unique_ptr<MapImport>> BeginMapImport(const std::string& path, ImportTarget target);

}  // namespace dhpmap
