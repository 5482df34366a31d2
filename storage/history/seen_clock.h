// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Nanoseconds from anywhere on, which only pass: std::chrono::steady_clock.
using PassingTime = std::function<std::int64_t()>;
/// `time`, or where that is empty the steady clock.
PassingTime OrSteadyClock(PassingTime time);

/// The time that servers have seen pass with a database open for writing. It never goes back, stands still while nobody
/// has the database open, and no setting of the system's clock moves it: by it what is kept is old. Thread-safe.
class SeenClock {
 public:
  /// Goes on from what the database has stored, or, if that is damaged, from the newest row that says when it was
  /// written.
  static Result<SeenClock> GoOn(sqlite::Database& database, PassingTime time);

  [[nodiscard]] std::int64_t Now_ns() const { return before_ns_ + time_() - began_ns_; }

 private:
  SeenClock(std::int64_t before_ns, PassingTime time)
      : before_ns_(before_ns), time_(std::move(time)), began_ns_(time_()) {}

  std::int64_t before_ns_;
  PassingTime time_;
  std::int64_t began_ns_;
};

/// Stores how far it has got, within a transaction.
Status StoreSeenTime(sqlite::Database& database, std::int64_t seen_ns);

}  // namespace dhpmap
