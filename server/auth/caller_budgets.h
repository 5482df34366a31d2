// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "server/base/byte_budget.h"

namespace dhpmap::auth {

/// Gives each principal a budget within a shared one, so that no principal can use all of it. Holds one for each
/// principal that has called, so at most one per key. Thread-safe.
class CallerBudgets {
 public:
  explicit CallerBudgets(double fraction) : fraction_(fraction) {}

  /// Returns the same budget for the same name and `all`. Bytes taken from it are taken from `all`, too.
  std::shared_ptr<ByteBudget> Of(const std::string& principal, const std::shared_ptr<ByteBudget>& all)
      DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    std::shared_ptr<ByteBudget>& budget = budgets_[{principal, all.get()}];
    if (budget == nullptr) {
      const auto limit_bytes = static_cast<std::size_t>(fraction_ * static_cast<double>(all->limit_bytes()));
      budget = std::make_shared<ByteBudget>(limit_bytes, all->free_bytes(), all);
    }
    return budget;
  }

 private:
  const double fraction_;
  Mutex mutex_;
  std::map<std::pair<std::string, ByteBudget*>, std::shared_ptr<ByteBudget>> budgets_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
