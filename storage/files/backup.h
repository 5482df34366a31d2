// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// Writes one state of the database to a new file, whatever commits meanwhile, in time that grows with the size.
/// ALREADY_EXISTS if there is a file at `path`, INVALID_ARGUMENT if there is no such folder, CANCELLED; then, and on
/// every other error, nothing is left at `path`.
Status WriteBackup(sqlite::Database& database, const std::string& path, const std::stop_token& stop);

/// A backup of the database at `path`, in a file beside it that has no name any more, so it goes when it was read.
Result<std::unique_ptr<StoreBackup>> MakeBackup(sqlite::Database& database, const std::string& path,
                                                const std::stop_token& stop);

/// A place for a file beside the database at `path`, which no other call gets.
std::string UnfinishedPath(const std::string& path);
/// The file at `place`, which loses its name.
Result<std::unique_ptr<StoreBackup>> OpenOnce(const std::string& place);

/// Removes what a process that was killed has left in such places. For the only writer of the database at `path`.
void RemoveUnfinishedBackups(const std::string& path);

}  // namespace dhpmap
