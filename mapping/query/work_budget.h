// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stop_token>
#include <utility>

namespace dhpmap {

/// What a question may cost, and whether anybody still waits for its answer. A unit is a triangle, a voxel or a step
/// that is looked at; for a large box it takes some 0.3 us. Once the budget is over, the question is given up and its
/// answer means nothing. Thread-compatible.
class WorkBudget {
 public:
  explicit WorkBudget(std::int64_t most = std::numeric_limits<std::int64_t>::max(), std::stop_token stop = {})
      : most_(most), stop_(std::move(stop)) {}

  /// False once it is over: more than all is spent, or a stop was requested a moment ago.
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

/// The same where there may be none.
inline bool SpendOf(WorkBudget* work, std::int64_t units) { return work == nullptr || work->Spend(units); }

}  // namespace dhpmap
