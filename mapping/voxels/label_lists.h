// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/labels/label_counts.h"

namespace dhpmap {

/// Label counts that do not fit into the cells of a block, by entry number: 8 bytes per voxel, and 4 bytes per count (8
/// in a voxel with an id or a count above 65,535). All lists share one array. A voxel keeps at most 65,535 classes and
/// 65,535 instances, those with the lowest ids. Thread-compatible.
class LabelLists {
 public:
  /// Returns the number of a new entry, or a reused one.
  std::uint32_t Add(const LabelHistograms& histograms);
  void Set(std::uint32_t entry, const LabelHistograms& histograms);
  void Remove(std::uint32_t entry);
  /// Adds observations of a class that also count for the own instance.
  void AddObservation(std::uint32_t entry, ClassId c, std::uint32_t count);

  /// Calls visit(LabelCount) for each class, by ascending id.
  template <typename Visitor>
  void VisitClasses(std::uint32_t number, Visitor&& visit) const {
    const Entry& entry = entries_[number];
    for (std::uint32_t i = 0; i < entry.num_classes; ++i) visit(At(entry, i));
  }
  /// Calls visit(InstanceCount) for each instance, likewise.
  template <typename Visitor>
  void VisitInstances(std::uint32_t number, Visitor&& visit) const {
    const Entry& entry = entries_[number];
    for (std::uint32_t i = entry.num_classes; i < entry.size(); ++i) {
      const LabelCount seen = At(entry, i);
      visit(InstanceCount{SeenInstance::FromCode(seen.id), seen.count});
    }
  }
  [[nodiscard]] LabelHistograms Get(std::uint32_t entry) const;

  [[nodiscard]] bool HasInstance(SeenInstance instance) const;
  /// Moves the counts of an instance to another, adding to those that it has.
  void RenameInstance(SeenInstance from, SeenInstance to);

  /// Does not count removed entries.
  [[nodiscard]] std::size_t NumEntries() const { return entries_.size() - free_.size(); }
  /// Makes room for that many entries.
  void Reserve(std::size_t num_entries) { entries_.reserve(num_entries); }
  /// Frees unused memory.
  void Shrink();
  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  struct Entry {
    std::uint32_t first : 31, is_wide : 1;  ///< index of its first word; whether ids and counts take two words each
    std::uint16_t num_classes, num_instances;
    [[nodiscard]] std::uint32_t size() const { return std::uint32_t{num_classes} + num_instances; }
    [[nodiscard]] std::uint32_t num_words() const { return size() * (is_wide != 0 ? 4u : 2u); }
  };
  static_assert(sizeof(Entry) == 8);

  /// The i-th count: classes, then instances as SeenInstance::code.
  [[nodiscard]] LabelCount At(const Entry& entry, std::size_t i) const {
    const std::uint16_t* const words = words_.data() + entry.first;
    if (entry.is_wide == 0) return {words[2 * i], words[2 * i + 1]};
    return {words[4 * i] | std::uint32_t{words[4 * i + 1]} << 16,
            words[4 * i + 2] | std::uint32_t{words[4 * i + 3]} << 16};
  }
  void Put(const Entry& entry, std::size_t i, const LabelCount& seen);
  /// Raises the count of an id among [begin, end). Returns whether there is one that can hold the sum.
  bool Raise(const Entry& entry, std::uint32_t begin, std::uint32_t end, LabelCount by);
  /// Moves all words together, into an array with room for `num_more`.
  void Compact(std::size_t num_more);

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;  ///< numbers of removed entries
  std::vector<std::uint16_t> words_;
  std::size_t num_unused_ = 0;  ///< words that belong to no entry
};

}  // namespace dhpmap
