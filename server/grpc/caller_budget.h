// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "server/base/byte_budget.h"

namespace dhpmap {

/// While it lives, calls that begin on this thread count in the caller's budget. Null: in the budget of all calls. A
/// handler begins on one thread and does not know its caller, so the thread carries the budget. Thread-compatible;
/// nesting is an error.
class CallerBudget {
 public:
  explicit CallerBudget(ByteBudget* budget);
  ~CallerBudget();
  CallerBudget(const CallerBudget&) = delete;
  CallerBudget& operator=(const CallerBudget&) = delete;
};

/// The caller's budget on this thread, else `of_all`. It lives as long as the server.
ByteBudget& BudgetHere(ByteBudget& of_all);

}  // namespace dhpmap
