// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/tied_voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "mapping/evidence/label_management.h"
#include "mapping/refinement/label_crf.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::AddSubmap;
using testing::AllIds;
using testing::Put;

constexpr SubmapId kBall{1}, kFloor{2};

/// A ball on a floor. Just behind its surface, low down, the two were seen as often: rays to the floor graze it.
class BallOnAFloor : public ::testing::Test {
 protected:
  BallOnAFloor() {
    for (int s = 0; s < 2; ++s) AddSubmap(map_);
    for (int x = -14; x < 14; ++x) {
      for (int y = -14; y < 14; ++y) {
        for (int z = -3; z < 20; ++z) Add({x, y, z});
      }
    }
  }

  [[nodiscard]] double ToBall_vox(VoxelIndex v) const {
    return std::hypot(v.x + 0.5, v.y + 0.5, v.z + 0.5 - kRadius_vox) - kRadius_vox;
  }

  [[nodiscard]] bool IsTied(VoxelIndex v) const {
    return ToBall_vox(v) < 0 && ToBall_vox(v) > -1 && v.z >= 0 && v.z < 4;
  }

  void Add(VoxelIndex v) {
    const double to_ball_vox = ToBall_vox(v), to_floor_vox = v.z + 0.5;
    const double distance_vox = std::min(to_ball_vox, to_floor_vox);
    if (std::abs(distance_vox) > 2) return;
    const SubmapId owner = to_ball_vox < to_floor_vox ? kBall : kFloor;
    const std::uint32_t other = kBall.value + kFloor.value - owner.value;
    LabelHistograms labels{.classes = {{1, 6}}, .instances = {{kOwnInstance, 6}}};
    if (IsTied(v)) labels.instances = {{kOwnInstance, 3}, {SeenInstance(SubmapId(other)), 3}};
    Put(*map_.FindMutable(owner), v, static_cast<float>(distance_vox * voxel_size_m_), 1.0f, labels);
  }

  static constexpr double kRadius_vox = 8;
  Map map_{testing::RandomMapInfo()};
  const double voxel_size_m_ = map_.info().config.voxel_size_m;
};

TEST_F(BallOnAFloor, WhatIsJustWithinTheBallStaysWithTheSurfaceBeforeIt) {
  ThreadPool pool(1);
  RefineLabels(AllIds(map_), map_, pool);
  std::map<VoxelIndex, SubmapId> holders;
  testing::ForEachVoxel(map_, [&](const Submap& submap, const BlockEntry& entry, int i) {
    holders[VoxelIn(entry.index, i)] = submap.id();
  });
  int num_tied = 0;
  for (const auto& [v, holder] : holders) {
    if (!IsTied(v)) continue;
    int num_of_ball = 0, num_of_floor = 0;
    for (const VoxelIndex n :
         {VoxelIndex{v.x - 1, v.y, v.z}, VoxelIndex{v.x + 1, v.y, v.z}, VoxelIndex{v.x, v.y - 1, v.z},
          VoxelIndex{v.x, v.y + 1, v.z}, VoxelIndex{v.x, v.y, v.z - 1}}) {
      if (ToBall_vox(n) <= 0) continue;
      ++(holders.at(n) == kBall ? num_of_ball : num_of_floor);
    }
    if (num_of_ball == 0 || num_of_floor > 0) continue;
    ++num_tied;
    EXPECT_EQ(holder, kBall) << v.x << ' ' << v.y << ' ' << v.z;
  }
  EXPECT_GT(num_tied, 50);
}

/// The rule, said by searching all members for each.
std::vector<SubmapId> KeptByAllPairs(const TileProblem& problem, const std::vector<SubmapId>& likeliest) {
  const auto voxel_of = [&](const TileProblem::Member& m) { return VoxelIn(problem.BlockOf(m).index, m.linear); };
  const auto distance_vox = [&](const TileProblem::Member& m) {
    return problem.BlockOf(m).entry->tsdf->distance_m[m.linear] / problem.voxel_size_m();
  };
  const auto are_across = [&](const TileProblem::Member& a, const TileProblem::Member& b) {
    return std::min(distance_vox(a), distance_vox(b)) < -0.01 && std::max(distance_vox(a), distance_vox(b)) > 0.01;
  };
  std::vector<SubmapId> kept = likeliest;
  for (std::size_t m = 0; m < problem.num_inner(); ++m) {
    const TileProblem::Member& member = problem.members()[m];
    std::map<SubmapId, std::uint32_t> seen;
    problem.VisitSeen(member, [&](std::uint32_t channel, std::uint32_t count) {
      seen[SubmapId(problem.channels().LabelAt(member.place, channel))] += count;
    });
    if (seen[likeliest[m]] == 0) continue;
    std::map<SubmapId, int> across;
    for (std::size_t n = 0; n < problem.members().size(); ++n) {
      const VoxelIndex a = voxel_of(member), b = voxel_of(problem.members()[n]);
      if (std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) != 1) continue;
      if (are_across(member, problem.members()[n])) across[likeliest[n]] += 1;
    }
    if (across[likeliest[m]] > 0) continue;
    int most = 0;
    for (const auto& [label, count] : seen) {
      if (count != seen[likeliest[m]] || across[label] <= most) continue;
      most = across[label];
      kept[m] = label;
    }
  }
  return kept;
}

class TiedVoxels : public ::testing::TestWithParam<unsigned> {};

TEST_P(TiedVoxels, AreKeptAsAllPairsSay) {
  Map map = testing::RandomMap(GetParam());
  ThreadPool pool(1);
  ManageLabels(AllIds(map), map, pool);
  std::mt19937 random(GetParam());
  // Ties all over.
  testing::ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    const std::uint32_t other = 1 + static_cast<std::uint32_t>(random() % 2);
    LabelHistograms labels{.classes = {{1, 2}}, .instances = {{kOwnInstance, 2}}};
    if (other != submap.id().value) labels.instances.push_back({SeenInstance(SubmapId(other)), 2});
    map.FindMutable(submap.id())->MutableLabels(entry.index).Set(i, labels);
  });
  const KnownInstances known(AllIds(map), map);
  const auto blocks = CollectBlocks(AllIds(map), map);
  std::size_t num_kept = 0;
  for (const CrfTile& tile : CutTiles(blocks, known, 2, 1, pool)) {
    const TileProblem problem(blocks, known, tile, 1, map.info().config.voxel_size_m);
    std::vector<SubmapId> likeliest;
    for (const TileProblem::Member& member : problem.members()) {
      std::vector<SubmapId> seen;
      problem.VisitSeen(member, [&](std::uint32_t channel, std::uint32_t) {
        seen.push_back(SubmapId(problem.channels().LabelAt(member.place, channel)));
      });
      likeliest.push_back(seen[random() % seen.size()]);
    }
    std::vector<SubmapId> kept = likeliest;
    KeepTiedWithTheirSurface(problem, kept);
    EXPECT_EQ(kept, KeptByAllPairs(problem, likeliest));
    for (std::size_t m = 0; m < kept.size(); ++m) num_kept += kept[m] != likeliest[m];
  }
  EXPECT_GT(num_kept, 10u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TiedVoxels, ::testing::Range(0u, 4u));

}  // namespace
}  // namespace dhpmap
