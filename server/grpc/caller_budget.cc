// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/caller_budget.h"

namespace dhpmap {
namespace {

thread_local ByteBudget* budget_here = nullptr;

}  // namespace

CallerBudget::CallerBudget(ByteBudget* budget) { budget_here = budget; }
CallerBudget::~CallerBudget() { budget_here = nullptr; }

ByteBudget& BudgetHere(ByteBudget& of_all) { return budget_here != nullptr ? *budget_here : of_all; }

}  // namespace dhpmap
