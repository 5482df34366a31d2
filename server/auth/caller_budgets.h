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

/// What each principal may have of a budget for all, so that nobody has all of it. Holds one for each principal there
/// has been, so as many as there are keys. Thread-safe.
class CallerBudgets {
 public:
  explicit CallerBudgets(double fraction) : fraction_(fraction) {}

  /// The same for the same name and budget. What is taken of it is taken of `all`, too.
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
