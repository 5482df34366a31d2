// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stop_token>
#include <utility>

namespace dhpmap {

/// Limits the work of a query, and stops it when its client is gone. A unit is a triangle, voxel or step; about 0.3 us
/// for a large box. Once the budget is spent, the query is abandoned and its answer meaningless. Thread-compatible.
class WorkBudget {
 public:
  explicit WorkBudget(std::int64_t most = std::numeric_limits<std::int64_t>::max(), std::stop_token stop = {})
      : most_(most), stop_(std::move(stop)) {}

  /// False once the budget is spent or a stop was requested.
  bool Spend(std::int64_t units) {
    spent_ += units;
    return spent_ < next_look_ || Look();
  }
  [[nodiscard]] std::int64_t spent() const { return spent_; }
  [[nodiscard]] bool is_over() const { return is_over_; }

 private:
  static constexpr std::int64_t kBetweenLooks = 4096;

  bool Look() {
    is_over_ = is_over_ || spent_ > most_ || stop_.stop_requested();
    next_look_ = is_over_ ? 0 : std::min(spent_ + kBetweenLooks, most_);
    return !is_over_;
  }

  std::int64_t most_;
  std::stop_token stop_;
  std::int64_t spent_ = 0;
  std::int64_t next_look_ = 0;
  bool is_over_ = false;
};

/// The same for an optional budget.
inline bool SpendOf(WorkBudget* work, std::int64_t units) { return work == nullptr || work->Spend(units); }

}  // namespace dhpmap
