// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/cell_slots.h"

#include <utility>

namespace dhpmap {
namespace {

constexpr double kMostGroups = 1 << 18;  // 2 MiB of pointers
constexpr double kFarthest_vox = 1 << 28;

/// Like VoxelAt and BlockOf, inlined; for points within kFarthest_vox.
Eigen::Array3i BlockAtVoxels(const Eigen::Array3d& p_vox) {
  Eigen::Array3i block;
  for (int axis = 0; axis < 3; ++axis) {
    const auto whole = static_cast<int>(p_vox[axis]);
    block[axis] = (whole - (p_vox[axis] < whole ? 1 : 0)) >> kBlockSideLog2;
  }
  return block;
}

}  // namespace

CellSlots::CellSlots(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger)
    : voxel_size_m_(voxel_size_m), side_m_(kBlockSide * voxel_size_m), ledger_(std::move(ledger)) {
  if (box_m.isEmpty()) return;
  const double group_m = kGroupSide * side_m_;
  const Eigen::Array3d first = ((box_m.min().array() - kReach_m) / group_m).floor();
  const Eigen::Array3d last = ((box_m.max().array() + kReach_m) / group_m).floor();
  const Eigen::Array3d count = last - first + 1;
  const bool is_far = !(first.abs().maxCoeff() + last.abs().maxCoeff() < kFarthest_vox / kBlockSide / kGroupSide);
  if (is_far || !(count.prod() <= kMostGroups)) return;
  first_ = (kGroupSide * first).cast<int>();
  num_groups_ = count.cast<int>();
  groups_ = std::vector<std::atomic<Group*>>(static_cast<std::size_t>(num_groups_.prod()));
  AddBytes(groups_.size() * sizeof(groups_[0]));
}

CellSlots::~CellSlots() {
  for (std::atomic<Group*>& group : groups_) delete group.load();
  ledger_->cell_bytes -= own_bytes_;
}

CellSlots::Slot* CellSlots::SlotAt(const Eigen::Vector3d& p_map) const {
  const Eigen::Array3d p_vox = p_map.array() / voxel_size_m_;
  if (!(p_vox.abs() < kFarthest_vox).all()) return nullptr;
  const Eigen::Array3i cell = BlockAtVoxels(p_vox) - first_;
  if (!(cell >= 0).all() || !(cell < kGroupSide * num_groups_).all()) return nullptr;
  const Eigen::Array3i group = cell / kGroupSide, in_group = cell - kGroupSide * group;
  std::atomic<Group*>& place =
      groups_[static_cast<std::size_t>(group.x() + num_groups_.x() * (group.y() + num_groups_.y() * group.z()))];
  Group* there = place.load(std::memory_order_acquire);
  if (there == nullptr) {
    auto made = std::make_unique<Group>();
    if (place.compare_exchange_strong(there, made.get(), std::memory_order_acq_rel)) {
      AddBytes(sizeof(Group));
      there = made.release();
    }
  }
  return &(*there)[static_cast<std::size_t>(in_group.x() + kGroupSide * (in_group.y() + kGroupSide * in_group.z()))];
}

Eigen::Vector3d CellSlots::CentreAt(const Eigen::Vector3d& p_map) const {
  const BlockIndex block = BlockAt(p_map);
  return BlockCorner(block, voxel_size_m_) + Eigen::Vector3d::Constant(side_m_ / 2);
}

BlockIndex CellSlots::BlockAt(const Eigen::Vector3d& p_map) const {
  const Eigen::Array3i block = BlockAtVoxels(p_map.array() / voxel_size_m_);
  return {block.x(), block.y(), block.z()};
}

}  // namespace dhpmap
