// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "server/base/byte_budget.h"

namespace dhpmap {

/// While it lives, what begins on this thread counts in its caller's budget: a handler begins in one piece, and is not
/// told who calls unless it asks. Null: in that of all calls. Thread-compatible; one within another is an error.
class CallerBudget {
 public:
  explicit CallerBudget(ByteBudget* budget);
  ~CallerBudget();
  CallerBudget(const CallerBudget&) = delete;
  CallerBudget& operator=(const CallerBudget&) = delete;
};

/// The budget of the call that begins on this thread, else that of all calls. It lives as long as the server.
ByteBudget& BudgetHere(ByteBudget& of_all);

}  // namespace dhpmap
