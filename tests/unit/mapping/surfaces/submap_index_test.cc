// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/submap_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>

namespace dhpmap {
namespace {

using SubmapList = std::vector<std::shared_ptr<const Submap>>;

/// A submap of a few blocks near its origin, which lies at `T_map_submap`.
std::shared_ptr<Submap> Solid(std::uint32_t id, const Transform& T_map_submap) {
  SubmapInfo info;
  info.id = SubmapId(id);
  info.voxel_size_m = 0.1;
  info.truncation_m = 0.3;
  info.T_map_submap = T_map_submap;
  auto submap = std::make_shared<Submap>(info, 1);
  for (int i = -1; i < 2; ++i) submap->MutableTsdf({i, 0, -i}).weight.fill(1);
  submap->UpdateBoundingSphere();
  return submap;
}

/// `spread_m` apart, each turned and put somewhere; the first stays where it is.
SubmapList RandomSubmaps(int count, double spread_m, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  SubmapList submaps{Solid(1, Transform::Identity())};
  for (int n = 1; n < count; ++n) {
    Transform T = Transform::Identity();
    T.translate(spread_m * Eigen::Vector3d{unit(random), unit(random), unit(random)});
    T.rotate(Eigen::AngleAxisd(3 * unit(random), Eigen::Vector3d{unit(random), unit(random), 1}.normalized()));
    submaps.push_back(Solid(static_cast<std::uint32_t>(n + 1), T));
  }
  return submaps;
}

std::set<SubmapId> IdsAround(const SubmapIndex& index, const Eigen::Vector3d& p_map) {
  std::set<SubmapId> ids;
  index.VisitAround(p_map, [&ids](const SubmapIndex::Entry& entry) { ids.insert(entry.submap().id()); });
  return ids;
}

TEST(SubmapIndex, LeavesOutNoSubmapThatHasAVoxelAtThePoint) {
  for (const double spread_m : {1.0, 30.0, 5e5}) {
    std::mt19937 random(7);
    const SubmapList submaps = RandomSubmaps(20, spread_m, random);
    const SubmapIndex index(submaps);
    for (const auto& submap : submaps) {
      for (const BlockEntry& entry : submap->blocks().entries()) {
        for (const int linear : {0, 7, 448, kBlockVoxels - 1}) {  // corners: nearest to the rim of the sphere
          const Eigen::Vector3d p = VoxelCentre(VoxelIn(entry.index, linear), submap->info().voxel_size_m);
          EXPECT_TRUE(IdsAround(index, submap->info().T_map_submap * p).contains(submap->id())) << spread_m;
        }
      }
    }
  }
}

TEST(SubmapIndex, VisitsOnlySubmapsWhoseSphereIsNear) {
  std::mt19937 random(8);
  const SubmapList submaps = RandomSubmaps(30, 10.0, random);
  const SubmapIndex index(submaps);
  std::uniform_real_distribution<double> unit(-10, 10);
  constexpr double kRim_m = 1e-4;  // rounding of single precision, ten times over
  for (int n = 0; n < 500; ++n) {
    const Eigen::Vector3d p{unit(random), unit(random), unit(random)};
    std::set<SubmapId> surely, perhaps;
    for (const auto& submap : submaps) {
      const BoundingSphere sphere = submap->BoundingSphereInMap();
      const double from_rim_m = (p - sphere.center_m).norm() - sphere.radius_m;
      if (from_rim_m < -kRim_m) surely.insert(submap->id());
      if (from_rim_m < kRim_m) perhaps.insert(submap->id());
    }
    const std::set<SubmapId> visited = IdsAround(index, p);
    EXPECT_TRUE(std::includes(visited.begin(), visited.end(), surely.begin(), surely.end()));
    EXPECT_TRUE(std::includes(perhaps.begin(), perhaps.end(), visited.begin(), visited.end()));
  }
}

TEST(SubmapIndex, BringsPointsIntoTheSubmapsFrame) {
  std::mt19937 random(9);
  const SubmapList submaps = RandomSubmaps(3, 10.0, random);
  const SubmapIndex index(submaps);
  ASSERT_EQ(index.entries().size(), 3u);
  const Eigen::Vector3d p(1, -2, 3);
  EXPECT_EQ(index.entries()[0].ToSubmap(p), p) << "not moved: not a bit may change";
  for (const SubmapIndex::Entry& entry : index.entries()) {
    EXPECT_NEAR((entry.submap().info().T_map_submap * entry.ToSubmap(p) - p).norm(), 0, 1e-12);
  }
}

TEST(SubmapIndex, BoxesInItsTreeHoldTheSubmapsBoxes) {
  std::mt19937 random(10);
  const SubmapList submaps = RandomSubmaps(300, 20.0, random);
  const SubmapIndex index(submaps);
  for (std::size_t number = 0; number < index.entries().size(); ++number) {
    const SubmapIndex::Entry& entry = index.entries()[number];
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p = entry.box_m().corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      const Eigen::Vector3f in_tree = index.InTree(entry.submap().info().T_map_submap * p);
      bool is_found = false;
      index.tree().VisitOverlapping(
          {in_tree, in_tree}, [&](std::size_t position) { is_found |= index.tree().items()[position] == number; });
      EXPECT_TRUE(is_found) << number;
    }
  }
}

TEST(SubmapIndex, UpdatedOverAndOverEqualsAFreshOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  SubmapList submaps = RandomSubmaps(120, 10.0, random);
  const auto entries_of = [&submaps] {
    std::vector<SubmapIndex::Entry> entries;
    for (const auto& submap : submaps) {
      entries.emplace_back(*submap,
                           Eigen::AlignedBox3d(Eigen::Vector3d(-0.8, 0, -0.8), Eigen::Vector3d(1.6, 0.8, 1.6)));
    }
    return entries;
  };
  SubmapIndex updated(entries_of());
  std::vector<SubmapList> alive{submaps};
  for (int step = 0; step < 60; ++step) {
    std::set<std::size_t> moved;
    for (std::size_t n = 0; n < 1 + random() % 4; ++n) moved.insert(random() % submaps.size());
    for (const std::size_t number : moved) {
      Transform T = Transform::Identity();
      const double spread_m = step == 40 ? 500 : 12;  // once far beyond all that was
      T.translate(spread_m * Eigen::Vector3d{unit(random), unit(random), unit(random)});
      T.rotate(Eigen::AngleAxisd(3 * unit(random), Eigen::Vector3d::UnitY()));
      submaps[number] = Solid(static_cast<std::uint32_t>(number + 1), T);
    }
    alive.push_back(submaps);
    updated = SubmapIndex(updated, entries_of(), std::vector<std::size_t>(moved.begin(), moved.end()));
    const SubmapIndex fresh(entries_of());
    EXPECT_TRUE(updated.box_m().contains(fresh.box_m())) << "it may be larger, by where things have been";
    for (int n = 0; n < 60; ++n) {
      const SubmapIndex::Entry& near = fresh.entries()[random() % submaps.size()];
      const Eigen::Vector3d p =
          near.submap().BoundingSphereInMap().center_m + Eigen::Vector3d{unit(random), unit(random), unit(random)};
      EXPECT_EQ(IdsAround(updated, p), IdsAround(fresh, p)) << step;
    }
    std::set<std::uint32_t> all;
    const Eigen::Vector3f everywhere = Eigen::Vector3f::Constant(1e6f);
    updated.tree().VisitOverlapping({-everywhere, everywhere},
                                    [&](std::size_t leaf) { all.insert(updated.tree().items()[leaf]); });
    EXPECT_EQ(all.size(), submaps.size());
  }
}

TEST(SubmapIndex, MadeFromAnotherPutsOnlyThoseElsewhereThatAre) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(-1, 1);
  SubmapList submaps = RandomSubmaps(200, 10.0, random);
  std::optional<SubmapIndex> last(submaps);
  EXPECT_EQ(last->num_replaced(), 0u);
  for (std::size_t step = 1; step <= 40; ++step) {
    const std::size_t number = random() % submaps.size();
    Transform T = Transform::Identity();
    T.translate(10 * Eigen::Vector3d{unit(random), unit(random), unit(random)});
    submaps[number] = Solid(static_cast<std::uint32_t>(number + 1), T);  // what was there is gone
    last.emplace(SubmapIndex(*last, submaps));
    EXPECT_EQ(last->num_replaced(), step) << "one a step";
    const SubmapIndex fresh(submaps);
    ASSERT_EQ(last->entries().size(), fresh.entries().size());
    for (int n = 0; n < 60; ++n) {
      const Eigen::Vector3d p = fresh.entries()[random() % submaps.size()].submap().BoundingSphereInMap().center_m +
                                Eigen::Vector3d{unit(random), unit(random), unit(random)};
      EXPECT_EQ(IdsAround(*last, p), IdsAround(fresh, p)) << step;
    }
  }
  // More or fewer of them are another tree.
  submaps.erase(submaps.begin() + 70);
  last.emplace(SubmapIndex(*last, submaps));
  EXPECT_EQ(last->num_replaced(), 0u);
  EXPECT_EQ(last->entries().size(), submaps.size());
}

TEST(SubmapIndex, LeavesOutEmptySubmaps) {
  SubmapInfo info;
  info.voxel_size_m = 0.1;
  const SubmapList submaps{std::make_shared<Submap>(info, 1), Solid(1, Transform::Identity())};
  EXPECT_EQ(SubmapIndex(submaps).entries().size(), 1u);
}

}  // namespace
}  // namespace dhpmap
