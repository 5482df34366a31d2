// SPDX-License-Identifier: BSD-3-Clause
// What an object leaves, found a block at a time, is what one voxel after the other finds.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mapping/map/vacated_space.h"

namespace dhpmap {
namespace {

constexpr double kGrid_m = 0.05;
constexpr int kLow = -14, kHigh = 19;  ///< voxels of the scene along each axis; no multiples of a block's side

/// A cloud of spheres with holes, as seen from everywhere: distances in a band of 2 voxels.
class RandomThings {
 public:
  explicit RandomThings(std::uint32_t seed) : random_(seed), map(InfoOfMap()) {}

  double Draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// For cells of some voxels whether they are chosen.
  class Cells {
   public:
    Cells(RandomThings& things, int side, double share)
        : side_(side), salt_(static_cast<std::uint32_t>(things.random_())), share_(share) {}
    [[nodiscard]] bool Has(VoxelIndex v) const {
      const auto cell = [this](int x) { return static_cast<std::uint32_t>((x - kLow) / side_); };
      std::uint32_t mixed = salt_ + cell(v.x) * 73856093u + cell(v.y) * 19349663u + cell(v.z) * 83492791u;
      mixed = (mixed ^ mixed >> 16) * 0x85EBCA6Bu;
      mixed = (mixed ^ mixed >> 13) * 0xC2B2AE35u;
      return static_cast<double>(mixed ^ mixed >> 16) < share_ * 4294967296.0;
    }

   private:
    const int side_;
    const std::uint32_t salt_;
    const double share_;
  };

  SubmapId Add(int num_spheres, double share_of_holes) {
    std::vector<std::pair<Eigen::Vector3d, double>> spheres;
    spheres.reserve(static_cast<std::size_t>(num_spheres));
    for (int n = 0; n < num_spheres; ++n) {
      spheres.emplace_back(Eigen::Vector3d(Draw(kLow, kHigh), Draw(kLow, kHigh), Draw(kLow, kHigh)), Draw(3, 11));
    }
    const Cells holes(*this, 3, share_of_holes);
    Submap& submap = map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = kGrid_m, .truncation_m = 2 * kGrid_m});
    ForEachVoxel([&](VoxelIndex v) {
      double distance_vox = 1e9;
      for (const auto& [center, radius] : spheres) {
        distance_vox = std::min(distance_vox, (Eigen::Vector3d(v.x, v.y, v.z) - center).norm() - radius);
      }
      if (std::abs(distance_vox) > 2 || holes.Has(v)) return;
      TsdfBlock& block = submap.MutableTsdf(BlockOf(v));
      const auto i = static_cast<std::size_t>(LinearIndex(v));
      block.distance_m[i] = static_cast<float>(distance_vox * kGrid_m);
      block.weight[i] = 1;
    });
    submap.UpdateBoundingSphere();
    return submap.id();
  }
  void LookThrough(double share) {
    const Cells seen(*this, 5, share);
    ForEachVoxel([&](VoxelIndex v) {
      if (!seen.Has(v)) return;
      FreeBlocks one;
      const int cell = CellOf(BlockOf(v));
      one.mixed = std::uint64_t{1} << cell;
      SetIn(one.masks[static_cast<std::size_t>(cell)], LinearIndex(v), true);
      map.mutable_free_space().Add(TileOf(BlockOf(v)), one, 7);
    });
  }
  template <typename Visit>
  static void ForEachVoxel(Visit&& visit) {
    for (int z = kLow; z < kHigh; ++z) {
      for (int y = kLow; y < kHigh; ++y) {
        for (int x = kLow; x < kHigh; ++x) visit(VoxelIndex{x, y, z});
      }
    }
  }

 private:
  static MapInfo InfoOfMap() {
    MapInfo info;
    info.name = "m";
    info.config.voxel_size_m = kGrid_m;
    info.config.truncation_m = 2 * kGrid_m;
    return info;
  }

  std::mt19937 random_;

 public:
  Map map;
};

bool IsShown(const Submap& submap, VoxelIndex v) {
  const BlockEntry* entry = submap.blocks().Find(BlockOf(v));
  return entry != nullptr && entry->tsdf != nullptr && entry->Shows(LinearIndex(v));
}

/// Voxel by voxel, as vacated_space.h says it.
std::set<VoxelIndex> LeftVoxelByVoxel(const Submap& leaving, const Map& map) {
  const auto is_others = [&](VoxelIndex v) {
    if (map.free_space().IsFree(v)) return true;
    for (const auto& other : map.submaps()) {
      if (other->id() != leaving.id() && IsShown(*other, v)) return true;
    }
    return false;
  };
  std::set<VoxelIndex> own;
  std::vector<VoxelIndex> behind;
  VoxelIndex low{1000, 1000, 1000}, high{-1000, -1000, -1000};
  RandomThings::ForEachVoxel([&](VoxelIndex v) {
    if (!IsShown(leaving, v)) return;
    own.insert(v);
    const float distance_m =
        leaving.blocks().Find(BlockOf(v))->tsdf->distance_m[static_cast<std::size_t>(LinearIndex(v))];
    if (distance_m <= static_cast<float>(0.5 * kGrid_m)) {
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    if (distance_m <= 0) behind.push_back(v);
  });
  const auto is_in_box = [&](VoxelIndex v) {
    return v.x >= low.x && v.x <= high.x && v.y >= low.y && v.y <= high.y && v.z >= low.z && v.z <= high.z;
  };
  while (!behind.empty()) {
    const VoxelIndex at = behind.back();
    behind.pop_back();
    for (const VoxelIndex next :
         {VoxelIndex{at.x + 1, at.y, at.z}, VoxelIndex{at.x - 1, at.y, at.z}, VoxelIndex{at.x, at.y + 1, at.z},
          VoxelIndex{at.x, at.y - 1, at.z}, VoxelIndex{at.x, at.y, at.z + 1}, VoxelIndex{at.x, at.y, at.z - 1}}) {
      if (!is_in_box(next) || own.contains(next) || is_others(next)) continue;
      own.insert(next);
      behind.push_back(next);
    }
  }
  std::erase_if(own, is_others);
  return own;
}

TEST(VacatedInside, IsWhatOneVoxelAfterTheOtherReaches) {
  std::size_t num_inside = 0;
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomThings things(seed);
    const SubmapId leaving = things.Add(1 + static_cast<int>(seed % 3), seed % 4 * 0.15);
    if (seed % 2 == 0) things.Add(1, 0.2);
    if (seed % 3 != 0) things.LookThrough(0.1);
    const std::set<VoxelIndex> expected = LeftVoxelByVoxel(*things.map.Find(leaving), things.map);
    NoteVacated(*things.map.Find(leaving), things.map);
    int num_wrong = 0;
    RandomThings::ForEachVoxel([&](VoxelIndex v) {
      num_wrong += things.map.vacated().IsFree(v) != expected.contains(v);
      num_inside += expected.contains(v) && !IsShown(*things.map.Find(leaving), v);
    });
    EXPECT_EQ(num_wrong, 0);
    EXPECT_EQ(static_cast<std::size_t>(things.map.vacated().NumFreeVoxels()), expected.size());
  }
  EXPECT_GT(num_inside, 1000u) << "there was something to reach";
}

}  // namespace
}  // namespace dhpmap
