// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// The blocks of a map that a step of its refinement has to do with: those of a region and of its rim. While mapping
/// goes on, what is kept of an older state is soon memory that only this state needs, so a step keeps no more than
/// that. Immutable, thread-safe.
class RegionPart {
 public:
  /// All of the map.
  RegionPart() = default;
  /// `rim`: see RimOfLabels.
  RegionPart(RefinementRegion region, int rim) : region_(std::move(region)), rim_(rim) {}

  [[nodiscard]] bool IsAll() const { return !region_.has_value(); }
  [[nodiscard]] bool Has(BlockIndex block) const { return IsAll() || region_->IsNear(block, rim_); }

 private:
  std::optional<RefinementRegion> region_;
  int rim_ = 0;
};

/// Goes on from a state with all of its submaps, and of their blocks with those of `part`. A submap that has observed
/// voxels elsewhere has one more block, so that it is not taken for empty. Free space is not in it, nor is the state
/// kept. RefineRegion does to those blocks what it does to them in the whole map; rows of submaps (sphere, counts of
/// classes) may become wrong.
Map GoOnFrom(const MapSnapshot& state, const RegionPart& part);

}  // namespace dhpmap
