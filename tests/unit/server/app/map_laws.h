// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/refinement/refine_map.h"
#include "tests/support/map_equality.h"

// Laws of every state of a map, and of two states of which one follows from the other.

namespace dhpmap::testing {

/// Numbers of known voxels and of their observations.
struct VoxelTotals {
  std::int64_t num_known = 0;
  std::uint64_t num_observations = 0;
  friend bool operator==(const VoxelTotals&, const VoxelTotals&) = default;
};

inline VoxelTotals TotalsOf(const Submap& submap) {
  VoxelTotals totals;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const bool is_observed = entry.tsdf != nullptr && entry.tsdf->IsObserved(i);
      const bool is_labelled = entry.labels != nullptr && !entry.labels->IsEmpty(i);
      totals.num_known += is_observed || is_labelled;
      if (is_labelled) totals.num_observations += entry.labels->NumObservations(i);
    }
  }
  return totals;
}

inline VoxelTotals TotalsOf(const MapSnapshot& map) {
  VoxelTotals totals;
  for (const auto& submap : map.submaps()) {
    const VoxelTotals own = TotalsOf(*submap);
    totals.num_known += own.num_known;
    totals.num_observations += own.num_observations;
  }
  return totals;
}

/// Whether sensors have looked through something of the map so often that it is no longer there.
inline bool HasContradictedVoxel(const MapSnapshot& map) {
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.gone != nullptr && i < kBlockVoxels; ++i) {
        if (entry.IsContradicted(i)) return true;
      }
    }
  }
  return false;
}

/// Positions that more than one of the submaps shows that share the map's grid and have settled: none once all is
/// refined. The unknown submap holds what is behind all of them.
inline std::int64_t NumSharedPositions(const MapSnapshot& map) {
  std::unordered_map<BlockIndex, std::bitset<kBlockVoxels>, BlockIndexHash> held;
  std::int64_t num_shared = 0;
  for (const auto& submap : map.submaps()) {
    if (submap->id() == kUnknownSubmap || !IsRefined(submap->info(), map.info().config)) continue;
    for (const BlockEntry& entry : submap->blocks().entries()) {
      std::bitset<kBlockVoxels>& of_block = held[entry.index];
      for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
        if (!entry.Shows(i)) continue;
        num_shared += of_block.test(static_cast<std::size_t>(i));
        of_block.set(static_cast<std::size_t>(i));
      }
    }
  }
  return num_shared;
}

inline ::testing::AssertionResult SpheresHoldWhatWasObserved(const MapSnapshot& map) {
  constexpr double kRounding = 1 + 1e-9;
  for (const auto& submap : map.submaps()) {
    const BoundingSphere& sphere = submap->bounding_sphere();
    const double side_m = kBlockSide * submap->info().voxel_size_m;
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf == nullptr || !entry.tsdf->HasObservedVoxel()) continue;
      const Eigen::Vector3d center_m =
          BlockCorner(entry.index, submap->info().voxel_size_m) + Eigen::Vector3d::Constant(side_m / 2);
      const Eigen::Vector3d farthest_m =
          (center_m - sphere.center_m).cwiseAbs() + Eigen::Vector3d::Constant(side_m / 2);
      if (!sphere.IsEmpty() && farthest_m.norm() <= sphere.radius_m * kRounding) continue;
      return ::testing::AssertionFailure() << "the sphere of submap " << submap->id().value << " does not hold all";
    }
  }
  return ::testing::AssertionSuccess();
}

/// Ids ascend, and all are below the next id.
inline ::testing::AssertionResult IdsAreInOrder(const MapSnapshot& map) {
  for (std::size_t s = 0; s < map.submaps().size(); ++s) {
    const SubmapId id = map.submaps()[s]->id();
    if (id >= map.info().next_submap_id) return ::testing::AssertionFailure() << id.value << " was not given out";
    if (s > 0 && !(map.submaps()[s - 1]->id() < id)) return ::testing::AssertionFailure() << id.value << " comes late";
  }
  return ::testing::AssertionSuccess();
}

/// The rounding of voxels in a store.
struct StoreRounding {
  double distance_m = 0;
  double weight_share = 0;
};

inline std::shared_ptr<const MapSnapshot> WithoutEdits(const MapSnapshot& map) {
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(map.submaps().size());
  for (const auto& submap : map.submaps()) {
    auto copy = std::make_shared<Submap>(*submap);
    copy->mutable_info().edited_revision = 0;
    submaps.push_back(std::move(copy));
  }
  return std::make_shared<const MapSnapshot>(map.info(), std::move(submaps), map.free_space(),
                                             VacatedSpace{map.vacated()});
}

/// Whether two states are equal up to revisions, and thus etags, and the next id.
inline ::testing::AssertionResult AreSameButForNumbers(const MapSnapshot& a, const MapSnapshot& b,
                                                       const StoreRounding& rounding) {
  const MapInfo &x = a.info(), &y = b.info();
  const auto differ = [](const char* what) { return ::testing::AssertionFailure() << what << " differ"; };
  if (x.history_id != y.history_id) return differ("histories");
  if (x.display_name != y.display_name) return differ("names of the map");
  if (!(x.merged == y.merged)) return differ("merged ids");
  if (!(x.pairs == y.pairs)) return differ("pairs");
  if (!(x.kept_clear == y.kept_clear)) return differ("regions that are kept clear");
  if (!(x.sessions == y.sessions)) return differ("sessions");
  ::testing::AssertionResult same =
      MapsAreEqual(*WithoutEdits(a), *WithoutEdits(b), rounding.distance_m, rounding.weight_share);
  for (std::size_t s = 0; same && s < a.submaps().size(); ++s) {
    const Submap &left = *a.submaps()[s], &right = *b.submaps()[s];
    const BoundingSphere &p = left.bounding_sphere(), &q = right.bounding_sphere();
    if (p.center_m != q.center_m || p.radius_m != q.radius_m) return differ("spheres") << " of " << left.id().value;
    if (left.info().instance_confidence != right.info().instance_confidence) {
      return differ("confidences") << " of " << left.id().value;
    }
  }
  return same;
}

/// The same, and the submaps' edited revisions are equal, too.
inline ::testing::AssertionResult AreSame(const MapSnapshot& a, const MapSnapshot& b, const StoreRounding& rounding) {
  if (a.revision() != b.revision()) {
    return ::testing::AssertionFailure() << "revisions " << a.revision() << " and " << b.revision();
  }
  if (a.info().next_submap_id != b.info().next_submap_id) return ::testing::AssertionFailure() << "next ids differ";
  ::testing::AssertionResult same = AreSameButForNumbers(a, b, rounding);
  for (std::size_t s = 0; same && s < a.submaps().size(); ++s) {
    const SubmapInfo &x = a.submaps()[s]->info(), &y = b.submaps()[s]->info();
    if (x.revision != y.revision || x.edited_revision != y.edited_revision) {
      return ::testing::AssertionFailure() << "revisions of submap " << x.id.value << " differ";
    }
  }
  return same;
}

/// Whether locked objects are unchanged, except for their last-seen time.
inline ::testing::AssertionResult LockedAreLeftAlone(const MapSnapshot& before, const MapSnapshot& after) {
  for (const auto& submap : before.submaps()) {
    if (!submap->info().is_locked) continue;
    const Submap* now = after.Find(submap->id());
    if (now == nullptr) return ::testing::AssertionFailure() << "locked submap " << submap->id().value << " is gone";
    Submap expected = *submap;
    expected.mutable_info().last_observed_ns = now->info().last_observed_ns;
    if (const auto same = SubmapsAreEqual(expected, *now); !same) {
      return ::testing::AssertionFailure() << "locked submap " << submap->id().value << ": " << same.message();
    }
  }
  return ::testing::AssertionSuccess();
}

/// Whether moved and cloned objects have the same voxels as before.
inline ::testing::AssertionResult PlacedHaveTheirVoxels(const MapSnapshot& before, const MapSnapshot& after) {
  for (const auto& submap : before.submaps()) {
    if (!submap->info().is_placed) continue;
    const Submap* now = after.Find(submap->id());
    const auto differs = [&] { return ::testing::AssertionFailure() << "placed submap " << submap->id().value; };
    if (now == nullptr) return differs() << " is gone";
    if (!(TotalsOf(*submap) == TotalsOf(*now))) return differs() << " has other counts";
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf == nullptr || !entry.tsdf->HasObservedVoxel()) continue;
      const BlockEntry* block = now->blocks().Find(entry.index);
      if (block == nullptr || block->tsdf == nullptr) return differs() << " lacks a block";
      for (std::size_t i = 0; i < static_cast<std::size_t>(kBlockVoxels); ++i) {
        const bool is_same =
            block->tsdf->weight[i] == entry.tsdf->weight[i] && block->tsdf->distance_m[i] == entry.tsdf->distance_m[i];
        if (!is_same) return differs() << " has other voxels";
      }
    }
  }
  return ::testing::AssertionSuccess();
}

}  // namespace dhpmap::testing
