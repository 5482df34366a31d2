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

/// Where what is known of the cells of one state of a map is kept; a cell is a block of the map's grid. Thread-safe;
/// nobody waits.
class CellSlots {
 public:
  /// Cells are of use up to so far from a surface: no less than what queries mostly ask for.
  static constexpr double kReach_m = 3.3;
  /// Times asked for that a slot can count.
  static constexpr std::uintptr_t kMostAsked = 255;

  /// Around `box_m`, in the map frame; empty: no cell is ever made, nor if the box is beyond all measure. What they
  /// take is added to the ledger while they are there.
  CellSlots(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger);
  CellSlots(const CellSlots&) = delete;
  CellSlots& operator=(const CellSlots&) = delete;

  [[nodiscard]] double side_m() const { return side_m_; }
  /// From a cell's centre to its corners.
  [[nodiscard]] double radius_m() const { return 0.8660254037844387 * side_m_; }
  [[nodiscard]] const SurfaceLedger& ledger() const { return *ledger_; }

  /// A cell's address, or how often it was asked for.
  using Slot = std::atomic<std::uintptr_t>;
  /// Where the cell at a point (finite) is kept; null: beyond the box.
  [[nodiscard]] Slot* SlotAt(const Eigen::Vector3d& p_map) const;
  /// The centre of the cell at a point of the box, in the map frame, and the block of the map's grid that the cell is.
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
  static constexpr int kGroupSide = 4;  // cells along an axis of a group, which is allocated as one
  using Group = std::array<Slot, std::size_t{kGroupSide} * kGroupSide * kGroupSide>;

  double voxel_size_m_;
  double side_m_;
  Eigen::Array3i first_ = Eigen::Array3i::Zero();  ///< block
  Eigen::Array3i num_groups_ = Eigen::Array3i::Zero();
  const std::shared_ptr<SurfaceLedger> ledger_;
  mutable std::vector<std::atomic<Group*>> groups_;
  mutable std::atomic<std::size_t> own_bytes_{0};
};

/// Cells of one kind, each made once it has been asked for often enough. `Cell::MemoryBytes()` says what one takes.
template <typename Cell>
class CellGrid : public CellSlots {
 public:
  /// `num_enough`: times asked for, up to kMostAsked, after which a cell is wanted.
  CellGrid(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger,
           std::uintptr_t num_enough)
      : CellSlots(box_m, voxel_size_m, std::move(ledger)), num_enough_(num_enough) {}
  ~CellGrid() {
    ForEachSlot([](const Slot& slot) {
      if (slot > kMostAsked) delete CellIn(slot.load());
    });
  }

  /// The cell, or null; then `num_asked` says how often it was asked for before, up to num_enough.
  [[nodiscard]] const Cell* Find(Slot& slot, std::uintptr_t& num_asked) const {
    std::uintptr_t there = slot.load(std::memory_order_acquire);
    if (there > kMostAsked) return CellIn(there);
    num_asked = there;
    // Counts that are lost to others who count do no harm.
    if (there < num_enough_) slot.compare_exchange_strong(there, there + 1, std::memory_order_relaxed);
    return nullptr;
  }
  /// The cell, or null; then `is_wanted` says whether the asker should make it, having been asked for often enough.
  [[nodiscard]] const Cell* Find(Slot& slot, bool& is_wanted) const {
    std::uintptr_t num_asked = 0;
    const Cell* cell = Find(slot, num_asked);
    is_wanted = cell == nullptr && num_asked == num_enough_;
    return cell;
  }
  /// Keeps a cell that was wanted, or the one that somebody else put there meanwhile. Valid as long as this.
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
  /// Of a slot above kMostAsked: it is a count or a cell, changed at once.
  [[nodiscard]] static const Cell* CellIn(std::uintptr_t slot) {
    return reinterpret_cast<const Cell*>(slot);  // NOLINT(performance-no-int-to-ptr)
  }

  const std::uintptr_t num_enough_;
};

}  // namespace dhpmap
