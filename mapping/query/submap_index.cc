// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/submap_index.h"

#include <utility>

namespace dhpmap {
namespace {

/// A sphere's cube, rounded outwards: a voxel at the rim must not be lost.
Eigen::AlignedBox3d CubeAround(const BoundingSphere& sphere) {
  const double radius_m = sphere.radius_m * (1 + 1e-9) + 1e-9 * sphere.center_m.norm();
  return {sphere.center_m - Eigen::Vector3d::Constant(radius_m), sphere.center_m + Eigen::Vector3d::Constant(radius_m)};
}

}  // namespace

SubmapIndex::Entry::Entry(const Submap& submap, const Eigen::AlignedBox3d& box_m)
    : submap_(&submap),
      T_submap_map_(submap.info().T_map_submap.inverse()),
      is_on_map_axes_(IsIdentity(submap.info().T_map_submap)),
      box_m_(box_m) {}

SubmapIndex::SubmapIndex(std::span<const std::shared_ptr<const Submap>> submaps) {
  for (const auto& submap : submaps) {
    if (!submap->bounding_sphere().IsEmpty()) entries_.emplace_back(*submap, CubeAround(submap->bounding_sphere()));
  }
  Build();
}

SubmapIndex::SubmapIndex(std::vector<Entry> entries) : entries_(std::move(entries)) { Build(); }

void SubmapIndex::Build() {
  std::vector<Eigen::AlignedBox3d> boxes_m;
  for (const Entry& entry : entries_) {
    boxes_m.push_back(entry.box_m().transformed(entry.submap().info().T_map_submap));
    box_m_.extend(boxes_m.back());
  }
  if (boxes_m.empty()) return;
  origin_m_ = box_m_.center();
  // Single precision, and rotations, must not lose a voxel at the rim.
  const float rounding_m = static_cast<float>(1e-6 * box_m_.sizes().norm() + 1e-9 * origin_m_.norm());
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const Eigen::AlignedBox3d& box : boxes_m) {
    boxes.emplace_back((box.min() - origin_m_).cast<float>() - Eigen::Vector3f::Constant(rounding_m),
                       (box.max() - origin_m_).cast<float>() + Eigen::Vector3f::Constant(rounding_m));
  }
  tree_ = BoxTree(boxes);
}

}  // namespace dhpmap
