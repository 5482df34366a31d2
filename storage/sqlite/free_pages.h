// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap::sqlite {

/// For an empty database: allows it to shrink, at the cost of one page in 820.
Status AllowGivingBack(Database& database);
/// Whether the database can shrink: not if it was created without AllowGivingBack.
Result<bool> AllowsGivingBack(Database& database);

/// Unused pages in the file.
Result<std::int64_t> NumFreePages(Database& database);

/// Moves pages from the end into free ones, until `num_pages` are cut off the end, within the present transaction. The
/// file itself is truncated by the next checkpoint.
Status GiveBackPages(Database& database, std::int64_t num_pages);

/// Result of a checkpoint.
enum class LogState {
  kEmptied,
  kInUse,  ///< a reader pins it, or there is a writer
};
/// Copies the log into the file as far as readers allow, while commits continue: but see SpaceReclaimer::CopyLog.
Result<LogState> CopyLog(Database& database);
/// Copies the log into the file as far as readers allow; if complete, truncates the log. No commit may run meanwhile.
Result<LogState> CutLog(Database& database);

}  // namespace dhpmap::sqlite
