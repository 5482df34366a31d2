// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/seen_clock.h"

#include <chrono>

#include "storage/rows/seen_rows.h"

namespace dhpmap {
namespace {

constexpr char kSeenTask[] = "see how much time has passed";

std::int64_t SteadyNow() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// The newest stamp of edits and changes.
Result<std::int64_t> NewestStamp(sqlite::Database& database) {
  return database.QueryInt(
      "SELECT max(ifnull((SELECT max(seen_ns) FROM edits), 0), ifnull((SELECT max(seen_ns) FROM changes), 0))",
      kSeenTask);
}

}  // namespace

PassingTime OrSteadyClock(PassingTime time) { return time ? std::move(time) : PassingTime(SteadyNow); }

Result<SeenClock> SeenClock::GoOn(sqlite::Database& database, PassingTime time) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement select, database.Prepare(SeenTable().Select("WHERE clock = 1"), kSeenTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
  SeenRow row;
  if (has_row && SeenTable().Read(select, row) && SeenTable().IsIntact(row, row.seal)) {
    return SeenClock(row.seen_ns, OrSteadyClock(std::move(time)));
  }
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t newest_ns, NewestStamp(database));
  return SeenClock(newest_ns, OrSteadyClock(std::move(time)));
}

Status StoreSeenTime(sqlite::Database& database, std::int64_t seen_ns) {
  SeenRow row{.seen_ns = seen_ns, .seal = {}};
  row.seal = SeenTable().SealOf(row);
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement upsert,
                          database.Prepare(SeenTable().Upsert(), "note how much time has passed"));
  SeenTable().BindAll(row, upsert);
  return upsert.Run();
}

}  // namespace dhpmap
