// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// A thing that a segment may match, on the map's grid or moved away from it.
struct ThingInView {
  const Submap* submap;
  Transform T_submap_map;
  BoundingSphere sphere_map;
  bool is_on_map_grid;
  float tolerance_m;
};

/// The things of a map that a frame may show, by ascending id, and which of its points hit which (see CountOverlaps).
/// Views the frame and the map. Immutable, thread-safe.
class ThingsInView {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  ThingsInView(const PanopticFrame& frame, const Map& map);

  [[nodiscard]] const std::vector<ThingInView>& list() const { return things_; }
  /// For each bundle of the segment the number in the list of the thing that it hits, or kNone.
  [[nodiscard]] std::vector<std::uint32_t> HitsOf(const SegmentBundles& segment) const;
  /// How many points of the segment lie on one thing of the list, whatever else they lie on.
  [[nodiscard]] std::int64_t NumPointsOn(const SegmentBundles& segment, std::size_t thing) const;

 private:
  /// Calls visit(cell, near) for each cell of the segment.
  template <typename Visitor>
  void VisitCells(const SegmentBundles& segment, std::span<const ThingInView> things, Visitor&& visit) const;

  const PanopticFrame& frame_;
  double voxel_size_m_;
  std::vector<ThingInView> things_;
};

}  // namespace dhpmap
