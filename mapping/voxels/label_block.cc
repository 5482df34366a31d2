// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/label_block.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dhpmap {
namespace {

/// The largest of the counts that visit_all(visit) visits.
template <typename Id, typename VisitAll>
BestSeen<Id> FindBest(const VisitAll& visit_all) {
  BestSeen<Id> best;
  std::uint64_t total = 0;
  visit_all([&](const SeenCount<Id>& seen) {
    total += seen.count;
    if (seen.count > best.count) best = {seen.id, seen.count, 0.0f};
  });
  if (total > 0) best.share = static_cast<float>(best.count) / static_cast<float>(total);
  return best;
}

}  // namespace

LabelBlock::Cell LabelBlock::Cell::OfOneClass(std::uint16_t id, std::uint32_t count) {
  if (count <= kMaxInlineCount) return {id, static_cast<std::uint16_t>(count), 0, 0};
  return {id, static_cast<std::uint16_t>(count), kWide, static_cast<std::uint16_t>(count >> 16)};
}

LabelBlock& LabelBlock::operator=(const LabelBlock& other) {
  LabelBlock copy(other);
  counts_ = std::move(copy.counts_);
  cells_ = std::move(copy.cells_);
  class_ = copy.class_;
  overflow_ = std::move(copy.overflow_);
  concluded_ = copy.concluded_;
  return *this;
}

LabelBlock::Cell& LabelBlock::Widen(int linear) {
  if (counts_) {
    Cells cells;
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if (counts_[i] != 0) cells[i] = Cell::OfOneClass(class_, counts_[i]);
    }
    cells_ = std::move(cells);
    counts_ = Counts::None();
  }
  return cells_[static_cast<std::size_t>(linear)];
}

bool LabelBlock::HasNoCount() const {
  if (class_ == kNoClass) return true;
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    if (counts_[i] != 0) return false;
  }
  return true;
}

bool LabelBlock::SetNarrow(int linear, LabelCount of_class) {
  if (!counts_) return false;
  if (of_class.id != class_ && HasNoCount()) class_ = static_cast<std::uint16_t>(of_class.id);
  if (of_class.id == class_ && of_class.count <= kMaxInlineCount) {
    counts_[static_cast<std::size_t>(linear)] = static_cast<std::uint16_t>(of_class.count);
    return true;
  }
  Widen(linear);
  return false;
}

void LabelBlock::AddObservationSlowly(int linear, ClassId c, std::uint32_t count) {
  if (counts_) {
    const std::uint32_t before = counts_[static_cast<std::size_t>(linear)];
    if (SetNarrow(linear, {c.value, SumOfCounts(before, count)})) return;
  }
  Cell& cell = Widen(linear);
  if (cell.class_a != kOverflow) {
    if (cell.IsEmpty() || (cell.class_a == c.value && cell.CountB() == 0)) {
      cell = Cell::OfOneClass(c.value, SumOfCounts(cell.CountA(), count));
      return;
    }
    if (cell.class_a == c.value && cell.count_a + count <= kMaxInlineCount) {
      cell.count_a = static_cast<std::uint16_t>(cell.count_a + count);
      return;
    }
    const bool b_takes_it = cell.count_b == 0 || (cell.class_b == c.value && cell.count_b + count <= kMaxInlineCount);
    if (!cell.IsWide() && cell.class_a != c.value && b_takes_it) {
      cell.class_b = c.value;
      cell.count_b = static_cast<std::uint16_t>(cell.count_b + count);
      return;
    }
  }
  if (cell.class_a == kOverflow) return overflow_.AddObservation(cell.Entry(), c, count);
  const LabelHistograms before = Get(linear), added = LabelHistograms::OfClass(c, count);
  cell = Cell::OfOverflow(
      overflow_.Add({SumCounts(before.classes, added.classes), SumCounts(before.instances, added.instances)}));
}

void LabelBlock::Add(int linear, const LabelHistograms& added) {
  const LabelHistograms old = Get(linear);
  const bool is_concluded = IsConcluded(linear);
  Set(linear, {SumCounts(old.classes, added.classes), SumCounts(old.instances, added.instances)});
  SetConcluded(linear, is_concluded);
}

void LabelBlock::Set(int linear, const LabelHistograms& histograms) {
  SetConcluded(linear, false);
  const auto& classes = histograms.classes;
  const auto& instances = histograms.instances;
  const bool is_own_alone = instances.size() == 1 && instances[0].id == kOwnInstance;
  const bool is_of_one_class =
      is_own_alone && classes.size() == 1 && classes[0].count != 0 && instances[0].count == classes[0].count;
  if (counts_ && classes.empty() && instances.empty()) {
    counts_[static_cast<std::size_t>(linear)] = 0;
    return;
  }
  if (is_of_one_class && SetNarrow(linear, classes[0])) return;
  Cell& cell = Widen(linear);
  if (cell.class_a == kOverflow) overflow_.Remove(cell.Entry());
  cell = {};
  if (classes.empty() && instances.empty()) return;

  if (is_of_one_class && classes[0].count > kMaxInlineCount) {
    cell = Cell::OfOneClass(static_cast<std::uint16_t>(classes[0].id), classes[0].count);
    return;
  }
  const bool small_counts = std::all_of(classes.begin(), classes.end(), [](const LabelCount& entry) {
    return entry.count >= 1 && entry.count <= kMaxInlineCount;
  });
  const std::uint64_t class_total =
      std::accumulate(classes.begin(), classes.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const LabelCount& entry) { return sum + entry.count; });
  if (small_counts && !classes.empty() && classes.size() <= 2 && is_own_alone && instances[0].count == class_total) {
    cell.class_a = static_cast<std::uint16_t>(classes[0].id);
    cell.count_a = static_cast<std::uint16_t>(classes[0].count);
    if (classes.size() == 2) {
      cell.class_b = static_cast<std::uint16_t>(classes[1].id);
      cell.count_b = static_cast<std::uint16_t>(classes[1].count);
    }
    return;
  }
  cell = Cell::OfOverflow(overflow_.Add(histograms));
}

bool LabelBlock::HasSeenInstance(SubmapId other) const { return overflow_.HasInstance(SeenInstance(other)); }

void LabelBlock::RenameInstance(SubmapId from, SeenInstance to) { overflow_.RenameInstance(SeenInstance(from), to); }

bool LabelBlock::IsEmpty(int linear) const {
  const Cell cell = CellAt(linear);
  return cell.class_a != kOverflow && cell.IsEmpty();
}

LabelHistograms LabelBlock::Get(int linear) const {
  const Cell cell = CellAt(linear);
  if (cell.class_a == kOverflow) return overflow_.Get(cell.Entry());
  LabelHistograms histograms;
  if (cell.IsEmpty()) return histograms;
  histograms.classes.push_back({cell.class_a, cell.CountA()});
  if (cell.CountB() != 0) histograms.classes.push_back({cell.class_b, cell.CountB()});
  if (cell.CountB() != 0 && cell.class_b < cell.class_a) std::swap(histograms.classes[0], histograms.classes[1]);
  histograms.instances.push_back({kOwnInstance, cell.Total()});
  return histograms;
}

BestLabel LabelBlock::BestClass(int linear) const {
  const Cell cell = CellAt(linear);
  if (cell.class_a == kOverflow) {
    return FindBest<std::uint32_t>([&](const auto& visit) { overflow_.VisitClasses(cell.Entry(), visit); });
  }
  if (cell.IsEmpty()) return {};
  const std::uint32_t a = cell.CountA(), b = cell.CountB();
  const bool b_wins = b > a || (b == a && cell.class_b < cell.class_a);
  const std::uint32_t best = b_wins ? b : a;
  return {b_wins ? cell.class_b : cell.class_a, best, static_cast<float>(best) / static_cast<float>(cell.Total())};
}

BestSeen<SeenInstance> LabelBlock::BestInstance(int linear) const {
  const Cell cell = CellAt(linear);
  if (cell.class_a == kOverflow) {
    return FindBest<SeenInstance>([&](const auto& visit) { overflow_.VisitInstances(cell.Entry(), visit); });
  }
  if (cell.IsEmpty()) return {};
  return {kOwnInstance, cell.Total(), 1.0f};
}

void LabelBlock::AddCountsTo(LabelTotals& totals) const {
  std::uint64_t all = 0, not_concluded = 0;
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    const std::uint32_t count = counts_[i];
    all += count;
    not_concluded += IsConcluded(static_cast<int>(i)) ? 0 : count;
  }
  totals.own += all;
  totals.instances += all;
  totals.AddClass(class_, not_concluded);
}

void LabelBlock::AddTo(LabelTotals& totals) const {
  if (counts_) return AddCountsTo(totals);
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    const Cell cell = CellAt(linear);
    if (cell.class_a != kOverflow && !IsConcluded(linear)) {  // true for nearly all
      const std::uint32_t own = cell.Total();
      if (own == 0) continue;
      totals.AddClass(cell.class_a, cell.CountA());
      if (cell.CountB() != 0) totals.AddClass(cell.class_b, cell.CountB());
      totals.own += own;
      totals.instances += own;
      continue;
    }
    if (!IsConcluded(linear)) VisitClasses(linear, [&](LabelCount seen) { totals.AddClass(seen.id, seen.count); });
    VisitInstances(linear, [&totals](InstanceCount seen) {
      totals.instances += seen.count;
      if (seen.id.IsOwn()) totals.own += seen.count;
    });
  }
}

std::uint64_t LabelBlock::NumObservations(int linear) const {
  const Cell cell = CellAt(linear);
  if (cell.class_a != kOverflow) return cell.Total();
  std::uint64_t total = 0;
  overflow_.VisitInstances(cell.Entry(), [&total](const InstanceCount& seen) { total += seen.count; });
  return total;
}

std::size_t LabelBlock::NumOverflowVoxels() const { return overflow_.NumEntries(); }

std::size_t LabelBlock::MemoryBytes() const { return sizeof(*this) + CountedBytes() + overflow_.MemoryBytes(); }

bool LabelBlock::operator==(const LabelBlock& other) const {
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (Get(i) != other.Get(i)) return false;
  }
  return concluded_ == other.concluded_;
}

}  // namespace dhpmap
