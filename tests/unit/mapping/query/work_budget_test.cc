// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/work_budget.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(WorkBudget, IsOverOnceMoreIsSpentThanThereIs) {
  WorkBudget work(10'000);
  for (int i = 0; i < 10'000; ++i) ASSERT_TRUE(work.Spend(1)) << i;
  EXPECT_FALSE(work.is_over());
  EXPECT_FALSE(work.Spend(1));
  EXPECT_TRUE(work.is_over());
  EXPECT_FALSE(work.Spend(0)) << "for good";
  EXPECT_EQ(work.spent(), 10'001);
}

TEST(WorkBudget, IsOverSoonAfterAStop) {
  std::stop_source caller;
  WorkBudget work(1'000'000'000, caller.get_token());
  for (int i = 0; i < 100'000; ++i) ASSERT_TRUE(work.Spend(1));
  caller.request_stop();
  int num_more = 0;
  while (work.Spend(1)) ++num_more;
  EXPECT_LT(num_more, 10'000);
}

TEST(WorkBudget, WhereThereIsNoneNothingEnds) {
  EXPECT_TRUE(SpendOf(nullptr, 1'000'000'000'000));
  WorkBudget endless;
  EXPECT_TRUE(endless.Spend(1'000'000'000'000));
}

}  // namespace
}  // namespace dhpmap
