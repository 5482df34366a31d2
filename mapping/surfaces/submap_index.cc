// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/submap_index.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

/// The cube around a sphere, rounded outwards, so that no voxel at the border is lost.
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

bool SubmapIndex::Entry::IsPlacedAs(const Entry& other) const {
  return box_m_.min() == other.box_m_.min() && box_m_.max() == other.box_m_.max() &&
         T_submap_map_.matrix() == other.T_submap_map_.matrix();
}

std::vector<SubmapIndex::Entry> SubmapIndex::EntriesOf(std::span<const std::shared_ptr<const Submap>> submaps) {
  std::vector<Entry> entries;
  entries.reserve(submaps.size());
  for (const auto& submap : submaps) {
    if (submap->IsAbsent() || submap->bounding_sphere().IsEmpty()) continue;
    entries.emplace_back(*submap, CubeAround(submap->bounding_sphere()));
  }
  return entries;
}

SubmapIndex SubmapIndex::After(const SubmapIndex& before, std::vector<Entry> entries) {
  std::vector<std::size_t> changed;
  for (std::size_t number = 0; number < std::min(entries.size(), before.entries_.size()); ++number) {
    if (!entries[number].IsPlacedAs(before.entries_[number])) changed.push_back(number);
  }
  return {before, std::move(entries), changed};
}

SubmapIndex::SubmapIndex(std::span<const std::shared_ptr<const Submap>> submaps) : SubmapIndex(EntriesOf(submaps)) {}

SubmapIndex::SubmapIndex(const SubmapIndex& before, std::span<const std::shared_ptr<const Submap>> submaps)
    : SubmapIndex(After(before, EntriesOf(submaps))) {}

SubmapIndex::SubmapIndex(std::vector<Entry> entries) : entries_(std::move(entries)) { Build(); }

SubmapIndex::SubmapIndex(const SubmapIndex& before, std::vector<Entry> entries, std::span<const std::size_t> changed)
    : entries_(std::move(entries)) {
  Eigen::AlignedBox3d box_m = before.box_m_;
  for (const std::size_t number : changed) box_m.extend(BoxInMap(entries_[number]));
  const bool is_in_reach = (box_m.min() - before.origin_m_).cwiseAbs().maxCoeff() <= before.reach_m_ &&
                           (box_m.max() - before.origin_m_).cwiseAbs().maxCoeff() <= before.reach_m_;
  // Rebuild the tree if half of the boxes have changed.
  if (!is_in_reach || before.entries_.size() != entries_.size() ||
      2 * (before.num_replaced_ + changed.size()) > entries_.size()) {
    Build();
    return;
  }
  box_m_ = box_m;
  origin_m_ = before.origin_m_;
  reach_m_ = before.reach_m_;
  tree_ = before.tree_;
  leaf_of_ = before.leaf_of_;
  num_replaced_ = before.num_replaced_ + changed.size();
  for (const std::size_t number : changed) tree_.Replace(leaf_of_[number], BoxInTree(BoxInMap(entries_[number])));
}

Eigen::AlignedBox3d SubmapIndex::BoxInMap(const Entry& entry) {
  return entry.box_m().transformed(entry.submap().info().T_map_submap);
}

Eigen::AlignedBox3f SubmapIndex::BoxInTree(const Eigen::AlignedBox3d& box_m) const {
  // Single precision and rotations must not lose a voxel at the border.
  const auto rounding_m = static_cast<float>(1e-6 * reach_m_ + 1e-9 * origin_m_.norm());
  return {(box_m.min() - origin_m_).cast<float>() - Eigen::Vector3f::Constant(rounding_m),
          (box_m.max() - origin_m_).cast<float>() + Eigen::Vector3f::Constant(rounding_m)};
}

void SubmapIndex::Build() {
  std::vector<Eigen::AlignedBox3d> boxes_m;
  for (const Entry& entry : entries_) {
    boxes_m.push_back(BoxInMap(entry));
    box_m_.extend(boxes_m.back());
  }
  if (boxes_m.empty()) return;
  origin_m_ = box_m_.center();
  reach_m_ = 2 * box_m_.sizes().norm();
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const Eigen::AlignedBox3d& box_m : boxes_m) boxes.push_back(BoxInTree(box_m));
  tree_ = BoxTree(boxes);
  leaf_of_.resize(boxes.size());
  for (std::size_t leaf = 0; leaf < boxes.size(); ++leaf)
    leaf_of_[tree_.items()[leaf]] = static_cast<std::uint32_t>(leaf);
}

}  // namespace dhpmap
