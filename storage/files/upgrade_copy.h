// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "mapping/base/result.h"
#include "storage/schema/migrate.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

struct UpgradeCopyOptions {
  bool is_kept = false;  ///< else KeepUpgradeCopy does nothing
  SchemaProgress progress = {};
  /// Bytes that may still be written in a folder; empty: as the file system says.
  std::function<Result<std::int64_t>(const std::string& folder)> free_bytes = {};
};

/// "maps.db.before-v15", beside the file that `path` leads to: a copy from before it was brought to schema 15.
std::string UpgradeCopyPath(const std::string& path, std::int64_t schema);

/// What a copy of the database may take, at most.
Result<std::int64_t> UpgradeCopyBytes(sqlite::Database& database);
/// Bytes that may still be written in the folder of `path`.
Result<std::int64_t> FreeBytesBeside(const std::string& path);
/// Bytes that are to stay free beside a copy.
inline constexpr std::int64_t kFreeBesideCopy_bytes = std::int64_t{64} << 20;

/// Before the first step from an older schema to this version's: keeps a copy of the database as it is, and tells
/// where. It is synced, and has its name only when it is whole. A copy that an interrupted upgrade has left is kept;
/// one of an earlier upgrade is replaced. FAILED_PRECONDITION if there is no room for it and 64 MiB more; errors of the
/// disk. Only for the single writer of the database at `path`.
Status KeepUpgradeCopy(sqlite::Database& database, const std::string& path, const UpgradeCopyOptions& options);

/// Adds to NEWER_SCHEMA what helps: the copy beside the database that this version can open, if there is one. Other
/// errors stay as they are.
Status WithWayBack(Status status, const std::string& path);

}  // namespace dhpmap
