// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "mapping/base/cache_line.h"
#include "mapping/base/grid.h"
#include "mapping/base/ids.h"
#include "mapping/labels/label_counts.h"
#include "mapping/voxels/label_lists.h"
#include "mapping/voxels/part_id.h"
#include "mapping/voxels/voxel_mask.h"
#include "mapping/voxels/voxel_plane.h"

namespace dhpmap {

/// The id with the largest count, and its share of all counts. Ties go to the smaller id; for instances, that is the
/// submap that holds the voxel. `count` and `share` are 0 for an empty list.
template <typename Id>
struct BestSeen {
  Id id{};
  std::uint32_t count = 0;
  float share = 0.0f;
};
using BestLabel = BestSeen<std::uint32_t>;

/// Sum of the counts of several voxels.
struct LabelTotals {
  std::vector<std::uint64_t> classes;    ///< by class id, without concluded voxels
  std::vector<std::uint32_t> seen;       ///< ids of the classes with a count, in any order
  std::uint64_t own = 0, instances = 0;  ///< count of the own instance, and of all instances

  void AddClass(std::uint32_t id, std::uint64_t count) {
    if (count == 0) return;
    if (id >= classes.size()) classes.resize(std::size_t{id} + 1);
    if (classes[id] == 0) seen.push_back(id);
    classes[id] += count;
  }
};

/// Exact label counts of one block (paper II-A, II-C). In most blocks, all voxels have seen at most one class and their
/// own submap: this takes 2 bytes per voxel. Other blocks permanently take 8 bytes per voxel, which hold counts of one
/// or two classes of the own instance inline. Everything else (a third class, another instance, a count above 65,535 of
/// one of two classes) goes to an overflow list. Counts saturate at 2^32 - 1. Thread-compatible.
///
/// Counts record observations only. Conclusions of refinement are separate: a bit marks a voxel that the submap holds
/// although another instance was observed there more often, or none was. Dropping these bits (ForgetConclusions) leaves
/// the observations.
class LabelBlock {
 public:
  PartId part_id;  ///< identity of this object; not part of its value

  LabelBlock() = default;
  LabelBlock(const LabelBlock& other) = default;
  /// Strong exception guarantee if memory runs out.
  LabelBlock& operator=(const LabelBlock& other);
  ~LabelBlock() = default;

  /// Adds an observation of class `c`, which also counts for the own instance (paper II-C). `count` is its weight, 1 to
  /// 65,535.
  void AddObservation(int linear, ClassId c, std::uint32_t count = 1) {
    if (!AddInPlace(linear, c, count)) AddObservationSlowly(linear, c, count);
  }
  /// The same if it only raises an existing count; otherwise changes nothing and returns false.
  bool AddInPlace(int linear, ClassId c, std::uint32_t count = 1) {
    const auto i = static_cast<std::size_t>(linear);
    if (counts_) {
      std::uint16_t& seen = counts_[i];
      if (class_ != c.value || seen + count > kMaxInlineCount) return false;
      seen = static_cast<std::uint16_t>(seen + count);  // true nearly always
      return true;
    }
    // Also raises the lower half of a wide count if that does not overflow.
    Cell& cell = cells_[i];
    if (cell.class_a != c.value || cell.count_a == 0 || cell.count_a + count > kMaxInlineCount) return false;
    cell.count_a = static_cast<std::uint16_t>(cell.count_a + count);
    return true;
  }
  /// Reverts the last AddInPlace of 1 in this voxel. Since then the block may only have been added to in place.
  void TakeBack(int linear) {
    const auto i = static_cast<std::size_t>(linear);
    std::uint16_t& seen = counts_ ? counts_[i] : cells_[i].count_a;
    seen = static_cast<std::uint16_t>(seen - 1);
  }

  /// Prefetches the counts for writing.
  void Fetch() const {
    constexpr int kToWrite = 1;
    const void* const values = counts_ ? static_cast<const void*>(&counts_[0]) : static_cast<const void*>(&cells_[0]);
    const auto* const bytes = static_cast<const char*>(values);
    for (std::size_t at = 0; at < CountedBytes(); at += kCacheLineBytes) __builtin_prefetch(bytes + at, kToWrite);
  }

  /// Adds whole histograms, such as those of a voxel of another submap; lists sorted by id, ids of classes below
  /// 65,535.
  void Add(int linear, const LabelHistograms& histograms);

  /// Whether the submap holds the voxel by conclusion, against its most frequent label.
  [[nodiscard]] bool IsConcluded(int linear) const { return IsIn(concluded_, linear); }
  void SetConcluded(int linear, bool is_concluded) { SetIn(concluded_, linear, is_concluded); }
  [[nodiscard]] const VoxelMask& concluded() const { return concluded_; }
  void set_concluded(const VoxelMask& concluded) { concluded_ = concluded; }

  /// Replaces a voxel's counts; empty lists clear it. Clears its conclusion.
  void Set(int linear, const LabelHistograms& histograms);
  void Clear(int linear) { Set(linear, {}); }
  /// Sets `count` observations of a class, and as many of the own instance, in a voxel without counts. The class is
  /// below 65,535, the count 1 to 65,535.
  void SetFirst(int linear, LabelCount of_class) {
    if (SetNarrow(linear, of_class)) return;
    cells_[static_cast<std::size_t>(linear)] =
        Cell::OfOneClass(static_cast<std::uint16_t>(of_class.id), of_class.count);
  }

  /// Reserves overflow entries for that many voxels.
  void ReserveOverflow(std::size_t num_voxels) { overflow_.Reserve(num_voxels); }

  /// Releases unused capacity.
  void ShrinkOverflow() { overflow_.Shrink(); }

  /// Whether some voxel has counts for the instance `other`, which is not the own one. Quick: few voxels have any.
  [[nodiscard]] bool HasSeenInstance(SubmapId other) const;
  /// Moves the counts of the instance `from` to `to`, adding to those that `to` has. `from` is not the own instance.
  void RenameInstance(SubmapId from, SeenInstance to);

  [[nodiscard]] bool IsEmpty(int linear) const;
  [[nodiscard]] LabelHistograms Get(int linear) const;

  /// Most frequent class, most frequent instance, and number of observations, without building lists.
  [[nodiscard]] BestLabel BestClass(int linear) const;
  [[nodiscard]] BestSeen<SeenInstance> BestInstance(int linear) const;
  /// Sum of the instance counts.
  [[nodiscard]] std::uint64_t NumObservations(int linear) const;
  /// Adds the counts of all voxels.
  void AddTo(LabelTotals& totals) const;

  /// Calls visit(LabelCount) for each class that has a count, in no fixed order.
  template <typename Visitor>
  void VisitClasses(int linear, Visitor&& visit) const;
  /// Calls visit(InstanceCount), likewise.
  template <typename Visitor>
  void VisitInstances(int linear, Visitor&& visit) const;

  [[nodiscard]] std::size_t NumOverflowVoxels() const;
  [[nodiscard]] std::size_t MemoryBytes() const;
  /// The part that MemoryKind::kBlocks counts.
  [[nodiscard]] std::size_t CountedBytes() const { return counts_ ? Counts::kBytes : Cells::kBytes; }
  bool operator==(const LabelBlock& other) const;

 private:
  // Inline: classes a and b with their counts, the own instance with count_a + count_b. count_a == 0 means empty.
  // Wide: class_b == kWide, class a alone, and count_b is the upper half of its count.
  // Overflow: class_a == kOverflow and the entry number in the other three fields.
  struct Cell {
    std::uint16_t class_a = 0, count_a = 0, class_b = 0, count_b = 0;
    // Of a cell that is not kOverflow.
    [[nodiscard]] bool IsWide() const { return class_b == kWide; }
    [[nodiscard]] bool IsEmpty() const { return count_a == 0 && !IsWide(); }
    [[nodiscard]] std::uint32_t CountA() const {
      return IsWide() ? count_a | static_cast<std::uint32_t>(count_b) << 16 : std::uint32_t{count_a};
    }
    [[nodiscard]] std::uint32_t CountB() const { return IsWide() ? 0u : std::uint32_t{count_b}; }
    [[nodiscard]] std::uint32_t Total() const { return CountA() + CountB(); }
    static Cell OfOneClass(std::uint16_t id, std::uint32_t count);
    static Cell OfOverflow(std::uint32_t entry) {
      return {kOverflow, static_cast<std::uint16_t>(entry), static_cast<std::uint16_t>(entry >> 16), 0};
    }
    /// The entry number of one that is kOverflow.
    [[nodiscard]] std::uint32_t Entry() const { return count_a | static_cast<std::uint32_t>(class_b) << 16; }
  };
  static constexpr std::uint16_t kOverflow = 0xFFFF;
  static constexpr std::uint16_t kWide = 0xFFFF;
  static constexpr std::uint16_t kNoClass = 0xFFFF;

  static constexpr std::uint32_t kMaxInlineCount = 0xFFFF;

  /// A voxel's cell, in either form of the block.
  [[nodiscard]] Cell CellAt(int linear) const {
    const auto i = static_cast<std::size_t>(linear);
    if (!counts_) return cells_[i];
    const std::uint16_t count = counts_[i];
    return count != 0 ? Cell{class_, count, 0, 0} : Cell{};
  }
  /// The cell for writing; converts counts to cells.
  Cell& Widen(int linear);
  /// Stores 0 to 65,535 observations of one class and the own instance as a plain count. Returns false, after
  /// converting to cells, if the block cannot hold it so.
  bool SetNarrow(int linear, LabelCount of_class);
  /// Whether a block of plain counts is empty, so that it may take any class.
  [[nodiscard]] bool HasNoCount() const;
  void AddCountsTo(LabelTotals& totals) const;
  void AddObservationSlowly(int linear, ClassId c, std::uint32_t count);

  using Counts = VoxelPlane<std::uint16_t>;
  using Cells = VoxelPlane<Cell>;
  static_assert(Cells::kBytes == 4096, "a page");
  // Exactly one of the two is in use.
  Counts counts_;
  Cells cells_ = Cells::None();
  std::uint16_t class_ = kNoClass;  ///< of the counts, from the first on
  LabelLists overflow_;
  VoxelMask concluded_{};
};

template <typename Visitor>
void LabelBlock::VisitClasses(int linear, Visitor&& visit) const {
  const Cell cell = CellAt(linear);
  if (cell.class_a == kOverflow) {
    overflow_.VisitClasses(cell.Entry(), visit);
    return;
  }
  if (const std::uint32_t count = cell.CountA(); count != 0) visit(LabelCount{cell.class_a, count});
  if (const std::uint32_t count = cell.CountB(); count != 0) visit(LabelCount{cell.class_b, count});
}

template <typename Visitor>
void LabelBlock::VisitInstances(int linear, Visitor&& visit) const {
  const Cell cell = CellAt(linear);
  if (cell.class_a == kOverflow) {
    overflow_.VisitInstances(cell.Entry(), visit);
    return;
  }
  if (const std::uint32_t own = cell.Total(); own != 0) visit(InstanceCount{kOwnInstance, own});
}

}  // namespace dhpmap
