// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// The blocks that a step of refinement needs: those of a region and of its rim. A step keeps no other blocks, because
/// while mapping continues, blocks of an older state soon take memory that no other state needs. Immutable,
/// thread-safe.
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

/// A map with all submaps of a state, and those of their blocks that are in `part`. A submap with observed voxels
/// elsewhere has one more block, so that it does not count as empty. The map has no free space and does not keep the
/// state. RefineRegion changes these blocks as it would in the whole map; rows of submaps (sphere, counts of classes)
/// may become wrong.
Map GoOnFrom(const MapSnapshot& state, const RegionPart& part);

}  // namespace dhpmap
