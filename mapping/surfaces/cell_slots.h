// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/surfaces/surface_ledger.h"

namespace dhpmap {

/// Storage for cached cells of one state of a map; a cell is a block of the map's grid. Thread-safe, without waiting.
class CellSlots {
 public:
  /// Cells are used up to this distance from a surface: at least the usual max_distance_m of queries.
  static constexpr double kReach_m = 3.3;
  /// The largest number of requests that a slot can count.
  static constexpr std::uintptr_t kMostAsked = 255;

  /// Covers `box_m`, in the map frame; if it is empty or too large, no cell is ever stored. The ledger counts the
  /// memory of the cells.
  CellSlots(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger);
  CellSlots(const CellSlots&) = delete;
  CellSlots& operator=(const CellSlots&) = delete;

  [[nodiscard]] double side_m() const { return side_m_; }
  /// From a cell's centre to its corners.
  [[nodiscard]] double radius_m() const { return 0.8660254037844387 * side_m_; }
  [[nodiscard]] const SurfaceLedger& ledger() const { return *ledger_; }

  /// The address of a cell, or the number of requests for it.
  using Slot = std::atomic<std::uintptr_t>;
  /// The slot of the cell at a point (finite); null: outside the box.
  [[nodiscard]] Slot* SlotAt(const Eigen::Vector3d& p_map) const;
  /// The centre of the cell at a point of the box, in the map frame, and the cell's block of the map's grid.
  [[nodiscard]] Eigen::Vector3d CentreAt(const Eigen::Vector3d& p_map) const;
  [[nodiscard]] BlockIndex BlockAt(const Eigen::Vector3d& p_map) const;

 protected:
  ~CellSlots();
  void AddBytes(std::size_t bytes) const {
    own_bytes_ += bytes;
    ledger_->cell_bytes += bytes;
  }
  template <typename Visitor>
  void ForEachSlot(Visitor&& visit) {
    for (std::atomic<Group*>& group : groups_) {
      if (group == nullptr) continue;
      for (Slot& slot : *group) visit(slot);
    }
  }

 private:
  static constexpr int kGroupSide = 4;  // cells along an axis of a group, which is one allocation
  using Group = std::array<Slot, std::size_t{kGroupSide} * kGroupSide * kGroupSide>;

  double voxel_size_m_;
  double side_m_;
  Eigen::Array3i first_ = Eigen::Array3i::Zero();  ///< block
  Eigen::Array3i num_groups_ = Eigen::Array3i::Zero();
  const std::shared_ptr<SurfaceLedger> ledger_;
  mutable std::vector<std::atomic<Group*>> groups_;
  mutable std::atomic<std::size_t> own_bytes_{0};
};

/// Cells of one kind. A cell is computed once it has been requested often enough. `Cell::MemoryBytes()` is its size.
template <typename Cell>
class CellGrid : public CellSlots {
 public:
  /// `num_enough`: the number of requests, up to kMostAsked, after which a cell is computed.
  CellGrid(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger,
           std::uintptr_t num_enough)
      : CellSlots(box_m, voxel_size_m, std::move(ledger)), num_enough_(num_enough) {}
  ~CellGrid() {
    ForEachSlot([](const Slot& slot) {
      if (slot > kMostAsked) delete CellIn(slot.load());
    });
  }

  /// The cell, or null; then `num_asked` is the number of earlier requests, up to num_enough.
  [[nodiscard]] const Cell* Find(Slot& slot, std::uintptr_t& num_asked) const {
    std::uintptr_t there = slot.load(std::memory_order_acquire);
    if (there > kMostAsked) return CellIn(there);
    num_asked = there;
    // A count that is lost to a concurrent thread does no harm.
    if (there < num_enough_) slot.compare_exchange_strong(there, there + 1, std::memory_order_relaxed);
    return nullptr;
  }
  /// The cell, or null; then `is_wanted` says whether the caller should compute it now.
  [[nodiscard]] const Cell* Find(Slot& slot, bool& is_wanted) const {
    std::uintptr_t num_asked = 0;
    const Cell* cell = Find(slot, num_asked);
    is_wanted = cell == nullptr && num_asked == num_enough_;
    return cell;
  }
  /// Stores a wanted cell. Returns it, or the cell that another thread has stored meanwhile. Valid as long as this.
  const Cell& Put(Slot& slot, std::unique_ptr<const Cell> cell) const {
    std::uintptr_t there = slot.load(std::memory_order_acquire);
    while (there <= kMostAsked) {
      if (!slot.compare_exchange_weak(there, reinterpret_cast<std::uintptr_t>(cell.get()), std::memory_order_acq_rel)) {
        continue;
      }
      AddBytes(cell->MemoryBytes());
      return *cell.release();
    }
    return *CellIn(there);
  }
  [[nodiscard]] std::uintptr_t num_enough() const { return num_enough_; }

 private:
  /// The cell in a slot with a value above kMostAsked; smaller values are counts.
  [[nodiscard]] static const Cell* CellIn(std::uintptr_t slot) {
    return reinterpret_cast<const Cell*>(slot);  // NOLINT(performance-no-int-to-ptr)
  }

  const std::uintptr_t num_enough_;
};

}  // namespace dhpmap
