// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/labels/seen_instance.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(SeenInstance, IsItsOwnUnlessItIsSaidToBeAnother) {
  EXPECT_TRUE(SeenInstance().IsOwn());
  EXPECT_TRUE(kOwnInstance.IsOwn());
  EXPECT_FALSE(SeenInstance(SubmapId(7)).IsOwn());
  EXPECT_EQ(SeenInstance::Of(SubmapId(7), SubmapId(7)), kOwnInstance);
  EXPECT_EQ(SeenInstance::Of(SubmapId(7), SubmapId(8)), SeenInstance(SubmapId(7)));
}

TEST(SeenInstance, ThatAVoxelNamesIsTheSameSubmapForWhoeverHoldsIt) {
  for (std::uint32_t holder = 1; holder < 5; ++holder) {
    EXPECT_EQ(kOwnInstance.In(SubmapId(holder)), SubmapId(holder));
    for (std::uint32_t submap = 1; submap < 5; ++submap) {
      EXPECT_EQ(SeenInstance::Of(SubmapId(submap), SubmapId(holder)).In(SubmapId(holder)), SubmapId(submap));
    }
  }
}

TEST(SeenInstance, IsStoredAsZeroForItsOwnAndElseByTheId) {
  EXPECT_EQ(kOwnInstance.code(), 0u) << "as all stored maps have it";
  EXPECT_EQ(SeenInstance(SubmapId(4'000'000'000u)).code(), 4'000'000'000u);
  for (const std::uint32_t code : {0u, 1u, 4'294'967'295u}) EXPECT_EQ(SeenInstance::FromCode(code).code(), code);
}

TEST(SeenInstance, OfItsOwnComesBeforeAllOthersWhichGoById) {
  EXPECT_LT(kOwnInstance, SeenInstance(SubmapId(1)));
  EXPECT_LT(SeenInstance(SubmapId(2)), SeenInstance(SubmapId(10)));
}

}  // namespace
}  // namespace dhpmap
