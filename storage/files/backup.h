// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// Copies one state of the database to a new file, without anything else: of any schema.
Status CopyInto(sqlite::Database& database, const std::string& path);

/// Writes one state of the database to a new file, in time linear in its size, while commits continue. ALREADY_EXISTS
/// if there is a file at `path`, INVALID_ARGUMENT if its folder does not exist, CANCELLED. After any error there is no
/// file at `path`.
Status WriteBackup(sqlite::Database& database, const std::string& path, const std::stop_token& stop);

/// A backup of the database at `path`, in an unlinked file of the same folder, which disappears once it is read.
Result<std::unique_ptr<StoreBackup>> MakeBackup(sqlite::Database& database, const std::string& path,
                                                const std::stop_token& stop);

/// A unique file name next to the database at `path`.
std::string UnfinishedPath(const std::string& path);
/// Opens the file at `place` and unlinks it.
Result<std::unique_ptr<StoreBackup>> OpenOnce(const std::string& place);

/// Removes such files left by killed processes. Only for the single writer of the database at `path`.
void RemoveUnfinishedBackups(const std::string& path);

}  // namespace dhpmap
