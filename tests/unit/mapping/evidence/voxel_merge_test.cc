// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/voxel_merge.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "mapping/voxels/block_table.h"
#include "mapping/voxels/tsdf_block.h"

namespace dhpmap {
namespace {

constexpr int kMergedVoxel = 77;
constexpr std::uint32_t kMostSubmaps = 5;

/// What a voxel of `holder` has seen of itself and of others, at random.
LabelHistograms RandomlySeen(SubmapId holder, std::mt19937& random) {
  LabelHistograms seen{.classes = {{1 + static_cast<std::uint32_t>(random() % 3), 4}}, .instances = {}};
  if (random() % 3 != 0) seen.instances.push_back({kOwnInstance, 1 + static_cast<std::uint32_t>(random() % 9)});
  for (std::uint32_t other = 1; other <= kMostSubmaps; ++other) {
    if (other == holder.value || random() % 2 == 0) continue;
    seen.instances.push_back({SeenInstance(SubmapId(other)), 1 + static_cast<std::uint32_t>(random() % 9)});
  }
  return seen;
}

BlockEntry BlockOfOneVoxel(const LabelHistograms& seen) {
  const auto tsdf = std::make_shared<TsdfBlock>();
  tsdf->weight[kMergedVoxel] = 2.0f;
  tsdf->distance_m[kMergedVoxel] = 0.25f;
  const auto labels = std::make_shared<LabelBlock>();
  labels->Set(kMergedVoxel, seen);
  return {.index = {}, .tsdf = tsdf, .labels = labels};
}

TEST(VoxelMerge, OfOneThatStaysChangesNothing) {
  std::mt19937 random(1);
  for (int n = 0; n < 200; ++n) {
    const SubmapId holder(1 + static_cast<std::uint32_t>(random() % kMostSubmaps));
    const LabelHistograms seen = RandomlySeen(holder, random);
    MergedVoxel merged;
    Accumulate(BlockOfOneVoxel(seen), holder, kMergedVoxel, merged);
    TsdfBlock tsdf;
    LabelBlock labels;
    Store(merged, holder, kMergedVoxel, tsdf, labels);
    EXPECT_EQ(labels.Get(kMergedVoxel), seen);
    EXPECT_EQ(tsdf.distance_m[kMergedVoxel], 0.25f);
    EXPECT_EQ(tsdf.weight[kMergedVoxel], 2.0f);
  }
}

TEST(VoxelMerge, CountsOfEachSubmapAddUpWhoeverNamesIt) {
  std::mt19937 random(2);
  for (int n = 0; n < 200; ++n) {
    MergedVoxel merged;
    std::map<SubmapId, std::uint32_t> expected, found;
    for (const SubmapId holder : {SubmapId(2), SubmapId(3), SubmapId(5)}) {
      const LabelHistograms seen = RandomlySeen(holder, random);
      for (const InstanceCount& count : seen.instances) expected[count.id.In(holder)] += count.count;
      Accumulate(BlockOfOneVoxel(seen), holder, kMergedVoxel, merged);
    }
    const SubmapId winner(1 + static_cast<std::uint32_t>(random() % kMostSubmaps));
    TsdfBlock tsdf;
    LabelBlock labels;
    Store(merged, winner, kMergedVoxel, tsdf, labels);
    SeenInstance last;
    for (const InstanceCount& count : labels.Get(kMergedVoxel).instances) {
      EXPECT_TRUE(count.id.IsOwn() || last < count.id) << "ascending";
      EXPECT_NE(count.id, SeenInstance(winner)) << "who holds it is its own instance";
      last = count.id;
      found[count.id.In(winner)] += count.count;
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(merged.num_holders, 3);
    EXPECT_EQ(merged.first_holder, SubmapId(2));
  }
}

}  // namespace
}  // namespace dhpmap
