// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/retrieval.h"

#include <gtest/gtest.h>

namespace dhpmap::evaluator {
namespace {

TEST(Retrieval, CopiesTheObjectAndNothingElseBothWays) {
  for (const std::int64_t num_object : {1, 512, 2000, 100'000}) {
    const RetrievalTimes times = MeasureRetrieval({100'000, num_object, {}}, 1);
    EXPECT_EQ(times.num_copied, num_object);
    EXPECT_GT(times.flat_bytes, 100'000u * 15);
    EXPECT_GT(times.map_bytes, 100'000u * 11);
  }
}

TEST(RetrievalClock, FindsASubmapFasterThanATraversal) {
  const RetrievalTimes times = MeasureRetrieval({400'000, 4'000, {}}, 3);
  EXPECT_LT(times.find_s * 10, times.traversal_s);
}

TEST(Retrieval, KnowsThePapersScenes) {
  ASSERT_EQ(PaperScenes().size(), 2u);
  EXPECT_EQ(PaperScenes()[1].num_voxels, 82'529'555);
  EXPECT_FALSE(ProcessorName().empty());
}

}  // namespace
}  // namespace dhpmap::evaluator
