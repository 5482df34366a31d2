// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/ids.h"
#include "mapping/map/voxel_mask.h"
#include "mapping/map/voxel_plane.h"

namespace dhpmap {

/// How often an id (a class, or an instance) was seen at a voxel.
struct LabelCount {
  std::uint32_t id = 0;
  std::uint32_t count = 0;
  constexpr bool operator==(const LabelCount&) const = default;
};

/// Everything a voxel has seen, each list by ascending id. In an instance list, id 0 stands for "the submap that holds
/// this voxel", so that a submap can be cloned or renumbered without touching its voxels.
struct LabelHistograms {
  std::vector<LabelCount> classes;
  std::vector<LabelCount> instances;
  bool operator==(const LabelHistograms&) const = default;
};

/// The id with the largest count, and that count's share of all counts. Ties go to the smaller id, which for instances
/// means: to the submap that holds the voxel. `id` is 0 and `share` 0 for an empty list.
struct BestLabel {
  std::uint32_t id = 0;
  std::uint32_t count = 0;
  float share = 0.0f;
};
BestLabel FindBest(std::span<const LabelCount> counts);

/// Sums two lists that are sorted by id.
std::vector<LabelCount> SumCounts(std::span<const LabelCount> a, std::span<const LabelCount> b);

/// What voxels have seen, summed up.
struct LabelTotals {
  std::vector<std::uint64_t> classes;    ///< by id, of voxels of which nothing is concluded
  std::uint64_t own = 0, instances = 0;  ///< counts of the own instance, and of all
};

/// Exact label counts of one block (paper II-A, II-C). Nearly every voxel has seen one instance, its own submap, and
/// one or two classes: those counts are inline in 8 bytes. Anything else (a third class, another instance, a count
/// above 65,535) moves the voxel to an overflow list without any cap. Thread-compatible.
///
/// Counts are what was seen, and nothing but more of it changes them. What refinement concludes from them is apart: a
/// voxel that the submap holds although it has seen another instance more often, or none at all, has a bit for it, and
/// dropping the bits (see ForgetConclusions) leaves what was seen.
class LabelBlock {
 public:
  /// Adds one observation of class `c` that also counts for the own instance (paper II-C).
  void AddObservation(int linear, ClassId c) {
    Cell& cell = cells_[linear];
    if (cell.class_a == c.value && cell.count_a - 1u < kMaxInlineCount - 1u) {  // 1..65534: by far the most frequent
      ++cell.count_a;
    } else {
      AddObservationSlowly(linear, c);
    }
  }

  /// Adds whole histograms, such as those of a voxel of another submap; lists sorted by id, ids of classes below
  /// 65,535.
  void Add(int linear, const LabelHistograms& histograms);

  /// Whether the submap holds the voxel by conclusion, against what was seen most.
  [[nodiscard]] bool IsConcluded(int linear) const { return IsIn(concluded_, linear); }
  void SetConcluded(int linear, bool is_concluded) { SetIn(concluded_, linear, is_concluded); }
  [[nodiscard]] const VoxelMask& concluded() const { return concluded_; }
  void set_concluded(const VoxelMask& concluded) { concluded_ = concluded; }

  /// Replaces a voxel's counts; empty lists clear it. Nothing is concluded of it.
  void Set(int linear, const LabelHistograms& histograms);
  void Clear(int linear) { Set(linear, {}); }

  /// Whether some voxel has seen the instance, which is not 0. Quick: few voxels have seen another than their own.
  [[nodiscard]] bool HasSeenInstance(std::uint32_t instance) const;
  /// What was seen of instance `from`, not 0, was `to`, 0 for the own one: their counts are added up.
  void RenameInstance(std::uint32_t from, std::uint32_t to);

  [[nodiscard]] bool IsEmpty(int linear) const;
  [[nodiscard]] LabelHistograms Get(int linear) const;

  /// Without building lists: the most seen class, the most seen instance (0 = own), and the number of observations.
  [[nodiscard]] BestLabel BestClass(int linear) const;
  [[nodiscard]] BestLabel BestInstance(int linear) const;
  /// Sum of the instance counts.
  [[nodiscard]] std::uint64_t NumObservations(int linear) const;
  /// Adds what all voxels have seen.
  void AddTo(LabelTotals& totals) const;

  /// Calls visit(LabelCount) for each class that the voxel has seen, in no fixed order.
  template <typename Visitor>
  void VisitClasses(int linear, Visitor&& visit) const;
  /// The same for instances, with id 0 for the own one.
  template <typename Visitor>
  void VisitInstances(int linear, Visitor&& visit) const;

  [[nodiscard]] std::size_t NumOverflowVoxels() const;
  [[nodiscard]] std::size_t MemoryBytes() const;
  bool operator==(const LabelBlock& other) const;

 private:
  // Inline: classes a and b with their counts, the own instance with count_a + count_b. count_a == 0 means empty.
  // Overflow: class_a == kOverflow and the entry number in the other three fields.
  struct Cell {
    std::uint16_t class_a = 0, count_a = 0, class_b = 0, count_b = 0;
  };
  static constexpr std::uint16_t kOverflow = 0xFFFF;

  static constexpr std::uint32_t kMaxInlineCount = 0xFFFF;

  void AddObservationSlowly(int linear, ClassId c);
  [[nodiscard]] const LabelHistograms& Overflow(const Cell& cell) const;
  LabelHistograms& MoveToOverflow(int linear);

  VoxelPlane<Cell> cells_;
  static_assert(decltype(cells_)::kBytes == 4096, "a page");
  std::vector<LabelHistograms> overflow_;
  std::vector<std::uint32_t> free_overflow_;
  VoxelMask concluded_{};
};

template <typename Visitor>
void LabelBlock::VisitClasses(int linear, Visitor&& visit) const {
  const Cell& cell = cells_[static_cast<std::size_t>(linear)];
  if (cell.class_a == kOverflow) {
    for (const LabelCount& entry : Overflow(cell).classes) visit(entry);
    return;
  }
  if (cell.count_a != 0) visit(LabelCount{cell.class_a, cell.count_a});
  if (cell.count_b != 0) visit(LabelCount{cell.class_b, cell.count_b});
}

template <typename Visitor>
void LabelBlock::VisitInstances(int linear, Visitor&& visit) const {
  const Cell& cell = cells_[static_cast<std::size_t>(linear)];
  if (cell.class_a == kOverflow) {
    for (const LabelCount& entry : Overflow(cell).instances) visit(entry);
    return;
  }
  const std::uint32_t own = std::uint32_t{cell.count_a} + cell.count_b;
  if (own != 0) visit(LabelCount{0, own});
}

}  // namespace dhpmap
