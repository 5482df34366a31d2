// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mapping/map/map.h"
#include "mapping/surfaces/index_trail.h"
#include "mapping/surfaces/submap_index.h"

namespace dhpmap {

/// The map's data at a point.
struct PointInfo {
  bool is_observed = false;  ///< false: only is_free is meaningful
  /// Sensors have looked through its voxel, and no submap has a surface within its truncation. If neither this nor
  /// is_observed holds, the point is unknown.
  bool is_free = false;
  SubmapId submap;  ///< the submap that answers; its id is the instance id, 0 = unknown object
  Panoptic panoptic = Panoptic::kUnknown;
  ClassId class_id;
  float distance_m = 0;  ///< TSDF value of the voxel that contains the point
  float weight = 0;
  Color color;
  float class_confidence = 0;     ///< share of the observations for class_id
  float instance_confidence = 0;  ///< share of the observations for submap
};

/// Point queries on one snapshot. If several submaps hold the point (before label management makes them exclusive),
/// their observations vote. Immutable, thread-safe.
class PointLookup {
 public:
  explicit PointLookup(std::shared_ptr<const MapSnapshot> snapshot);
  /// The same with an index derived from that of another state of the map, and kept for the next.
  PointLookup(std::shared_ptr<const MapSnapshot> snapshot, IndexTrail& trail);

  [[nodiscard]] const MapSnapshot& snapshot() const { return *snapshot_; }

  [[nodiscard]] const SubmapIndex& index() const { return *index_; }

  /// `p_map`: finite, in metres of the map frame.
  [[nodiscard]] PointInfo At(const Eigen::Vector3d& p_map) const;

 private:
  std::shared_ptr<const MapSnapshot> snapshot_;
  std::shared_ptr<const SubmapIndex> index_;  // of the snapshot's submaps
};

}  // namespace dhpmap
