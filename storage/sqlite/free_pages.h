// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap::sqlite {

/// For a database without any table yet: its free pages can be given back, which costs a page in 820.
Status AllowGivingBack(Database& database);
/// Whether they can: not in a database that was made without AllowGivingBack.
Result<bool> AllowsGivingBack(Database& database);

/// Pages in the file that nothing uses.
Result<std::int64_t> NumFreePages(Database& database);

/// Moves what is on the last pages into free ones, until `num_pages` are free at the end of the file and cut off: in
/// the present transaction. The file itself is cut when the log is copied into it.
Status GiveBackPages(Database& database, std::int64_t num_pages);

/// How far the write-ahead log was emptied.
enum class LogState {
  kEmptied,
  kInUse,  ///< somebody reads a state that needs it, or writes
};
/// Copies the log into the file as far as readers allow, while commits go on: but see SpaceReclaimer::CopyLog.
Result<LogState> CopyLog(Database& database);
/// Copies the log into the file as far as readers allow; where it got to the end, cuts the log's file to nothing. No
/// commit may run meanwhile.
Result<LogState> CutLog(Database& database);

}  // namespace dhpmap::sqlite
