// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Monotonic time in ns with an arbitrary origin: std::chrono::steady_clock.
using PassingTime = std::function<std::int64_t()>;
/// `time`, or the steady clock if that is empty.
PassingTime OrSteadyClock(PassingTime time);

/// The time during which servers had the database open for writing. Monotonic, stopped while the database is closed,
/// and independent of the system clock. Ages of kept data refer to it. Thread-safe.
class SeenClock {
 public:
  /// Continues from the stored value or, if that is damaged, from the newest time stored in any row.
  static Result<SeenClock> GoOn(sqlite::Database& database, PassingTime time);

  [[nodiscard]] std::int64_t Now_ns() const { return before_ns_ + time_() - began_ns_; }

 private:
  SeenClock(std::int64_t before_ns, PassingTime time)
      : before_ns_(before_ns), time_(std::move(time)), began_ns_(time_()) {}

  std::int64_t before_ns_;
  PassingTime time_;
  std::int64_t began_ns_;
};

/// Stores the present value, within a transaction.
Status StoreSeenTime(sqlite::Database& database, std::int64_t seen_ns);

}  // namespace dhpmap
