// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// A thing or background whose relations are searched, in the query's frame, whose z is up.
struct RelatedBody {
  std::size_t number = 0;  ///< in MapSurfaces
  const Submap* submap = nullptr;
  Eigen::AlignedBox3d box_m;  ///< around its surface

  [[nodiscard]] bool IsThing() const { return submap->info().panoptic == Panoptic::kThing; }
  [[nodiscard]] SubmapId id() const { return submap->id(); }
};

/// A thing with points of its surface, evenly chosen.
struct RelatedThing {
  const RelatedBody& body;
  std::vector<Eigen::Vector3d> points_m;
  [[nodiscard]] double voxel_m() const { return body.submap->info().voxel_size_m; }
};

}  // namespace dhpmap
