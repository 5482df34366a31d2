// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/shown_mask.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>

namespace dhpmap {
namespace {

TEST(ShownMask, OfAConditionHasTheVoxelsThatOneByOneHaveIt) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::array<float, kBlockVoxels> values{};
    for (float& value : values) value = static_cast<float>(random() % 5) - 2.0f;
    values[random() % values.size()] = std::numeric_limits<float>::quiet_NaN();
    const float limit = static_cast<float>(random() % 5) - 2.0f;
    const VoxelMask mask = MaskWhere(values, [limit](float value) { return value <= limit; });
    for (int i = 0; i < kBlockVoxels; ++i) {
      ASSERT_EQ(IsIn(mask, i), values[static_cast<std::size_t>(i)] <= limit) << i;
    }
  }
}

TEST(ShownMask, OfOneVoxelIsThatBit) {
  for (int one = 0; one < kBlockVoxels; ++one) {
    std::array<std::uint8_t, kBlockVoxels> values{};
    values[static_cast<std::size_t>(one)] = 7;
    VoxelMask expected{};
    SetIn(expected, one, true);
    ASSERT_EQ(MaskWhere(values, [](std::uint8_t value) { return value == 7; }), expected) << one;
  }
}

TEST(ShownMask, OfWhatABlockShowsIsWithoutWhatIsContradicted) {
  std::mt19937 random(4);
  TsdfBlock tsdf;
  GoneBlock gone;
  for (int i = 0; i < kBlockVoxels; ++i) {
    constexpr float kWeights[] = {0.0f, 0.5f * kMinObservedWeight, kMinObservedWeight, 4.0f};
    tsdf.weight[static_cast<std::size_t>(i)] = kWeights[random() % 4];
    gone.Set(i, static_cast<int>(random() % 4));
  }
  BlockEntry entry;
  entry.tsdf = std::make_shared<const TsdfBlock>(tsdf);
  for (const auto& layer : {std::shared_ptr<const GoneBlock>(), std::make_shared<const GoneBlock>(gone)}) {
    entry.gone = layer;
    const VoxelMask shown = ShownMask(entry);
    for (int i = 0; i < kBlockVoxels; ++i) ASSERT_EQ(IsIn(shown, i), entry.Shows(i)) << i;
  }
}

}  // namespace
}  // namespace dhpmap
