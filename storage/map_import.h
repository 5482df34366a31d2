// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// Runs its argument as one durable transaction of the writer.
using WriteDurably = std::function<Status(const std::function<Status(sqlite::Database&)>&)>;

/// An import into the database at `path`; what has come in lies in a file beside it.
Result<std::unique_ptr<MapImport>> BeginMapImport(const std::string& path, WriteDurably write);

}  // namespace dhpmap
