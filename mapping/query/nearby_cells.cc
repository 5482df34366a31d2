// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/nearby_cells.h"

#include <utility>

namespace dhpmap {
namespace {

constexpr double kMostGroups = 1 << 18;  // 2 MiB of pointers
constexpr double kFarthest_vox = 1 << 28;

/// As VoxelAt and BlockOf, without a call: of a point that is no farther than kFarthest_vox.
Eigen::Array3i BlockAtVoxels(const Eigen::Array3d& p_vox) {
  Eigen::Array3i block;
  for (int axis = 0; axis < 3; ++axis) {
    const auto whole = static_cast<int>(p_vox[axis]);
    block[axis] = (whole - (p_vox[axis] < whole ? 1 : 0)) >> kBlockSideLog2;
  }
  return block;
}

}  // namespace

NearbyCells::NearbyCells(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger)
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
  own_bytes_ = groups_.size() * sizeof(groups_[0]);
  ledger_->cell_bytes += own_bytes_;
}

NearbyCells::~NearbyCells() {
  for (std::atomic<Group*>& group : groups_) {
    if (group == nullptr) continue;
    for (const Slot& slot : *group) {
      if (slot > kEnough) delete reinterpret_cast<const NearbyCell*>(slot.load());
    }
    delete group.load();
  }
  ledger_->cell_bytes -= own_bytes_;
}

NearbyCells::Slot* NearbyCells::SlotAt(const Eigen::Vector3d& p_map) const {
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
      own_bytes_ += sizeof(Group);
      ledger_->cell_bytes += sizeof(Group);
      there = made.release();
    }
  }
  return &(*there)[static_cast<std::size_t>(in_group.x() + kGroupSide * (in_group.y() + kGroupSide * in_group.z()))];
}

const NearbyCell* NearbyCells::Find(Slot& slot, bool& is_wanted) const {
  std::uintptr_t there = slot.load(std::memory_order_acquire);
  is_wanted = there == kEnough;
  if (there > kEnough) return reinterpret_cast<const NearbyCell*>(there);
  // Counts that are lost to others who count do no harm.
  if (!is_wanted) slot.compare_exchange_strong(there, there + 1, std::memory_order_relaxed);
  return nullptr;
}

Eigen::Vector3d NearbyCells::CentreAt(const Eigen::Vector3d& p_map) const {
  const BlockIndex block = BlockAt(p_map);
  return BlockCorner(block, voxel_size_m_) + Eigen::Vector3d::Constant(side_m_ / 2);
}

BlockIndex NearbyCells::BlockAt(const Eigen::Vector3d& p_map) const {
  const Eigen::Array3i block = BlockAtVoxels(p_map.array() / voxel_size_m_);
  return {block.x(), block.y(), block.z()};
}

const NearbyCell& NearbyCells::Put(Slot& slot, std::unique_ptr<const NearbyCell> cell) const {
  std::uintptr_t there = slot.load(std::memory_order_acquire);
  while (there <= kEnough) {
    if (!slot.compare_exchange_weak(there, reinterpret_cast<std::uintptr_t>(cell.get()), std::memory_order_acq_rel)) {
      continue;
    }
    own_bytes_ += cell->MemoryBytes();
    ledger_->cell_bytes += cell->MemoryBytes();
    return *cell.release();
  }
  return *reinterpret_cast<const NearbyCell*>(there);
}

}  // namespace dhpmap
