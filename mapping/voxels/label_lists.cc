// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/label_lists.h"

#include <algorithm>

namespace dhpmap {
namespace {

constexpr std::size_t kMostItems = 0xFFFF;
constexpr std::uint32_t kMostNarrow = 0xFFFF;

std::uint16_t NumKept(std::size_t num) { return static_cast<std::uint16_t>(std::min(num, kMostItems)); }

bool IsWide(const LabelHistograms& histograms) {
  return std::any_of(histograms.classes.begin(), histograms.classes.end(),
                     [](const LabelCount& seen) { return std::max(seen.id, seen.count) > kMostNarrow; }) ||
         std::any_of(histograms.instances.begin(), histograms.instances.end(),
                     [](const InstanceCount& seen) { return std::max(seen.id.code(), seen.count) > kMostNarrow; });
}

/// Adds room where growth is likely: most blocks have few lists.
std::size_t WithSlack(std::size_t num) { return num + num / 8; }

}  // namespace

std::uint32_t LabelLists::Add(const LabelHistograms& histograms) {
  auto number = static_cast<std::uint32_t>(entries_.size());
  if (free_.empty()) {
    if (number == entries_.capacity()) entries_.reserve(WithSlack(number) + 1);
    entries_.push_back({0, 0, 0, 0});
  } else {
    number = free_.back();
    free_.pop_back();
  }
  Set(number, histograms);
  return number;
}

void LabelLists::Set(std::uint32_t number, const LabelHistograms& histograms) {
  Entry next{entries_[number].first, IsWide(histograms) ? 1u : 0u, NumKept(histograms.classes.size()),
             NumKept(histograms.instances.size())};
  if (const std::size_t num_words = next.num_words(); num_words != entries_[number].num_words()) {
    if (words_.size() + num_words > words_.capacity()) Compact(num_words);
    num_unused_ += entries_[number].num_words();
    next.first = static_cast<std::uint32_t>(words_.size()) & 0x7FFFFFFFu;
    words_.resize(words_.size() + num_words);
  }
  entries_[number] = next;
  std::uint32_t i = 0;
  for (; i < next.num_classes; ++i) Put(next, i, histograms.classes[i]);
  for (; i < next.size(); ++i) {
    const InstanceCount& seen = histograms.instances[i - next.num_classes];
    Put(next, i, {seen.id.code(), seen.count});
  }
}

void LabelLists::Put(const Entry& entry, std::size_t i, const LabelCount& seen) {
  std::uint16_t* const words = words_.data() + entry.first;
  const auto low = [](std::uint32_t value) { return static_cast<std::uint16_t>(value); };
  const auto high = [](std::uint32_t value) { return static_cast<std::uint16_t>(value >> 16); };
  if (entry.is_wide == 0) {
    words[2 * i] = low(seen.id), words[2 * i + 1] = low(seen.count);
  } else {
    words[4 * i] = low(seen.id), words[4 * i + 1] = high(seen.id);
    words[4 * i + 2] = low(seen.count), words[4 * i + 3] = high(seen.count);
  }
}

void LabelLists::Remove(std::uint32_t number) {
  free_.push_back(number);
  num_unused_ += entries_[number].num_words();
  entries_[number] = {0, 0, 0, 0};
}

bool LabelLists::Raise(const Entry& entry, std::uint32_t begin, std::uint32_t end, LabelCount by) {
  for (std::uint32_t i = begin; i < end; ++i) {
    const LabelCount seen = At(entry, i);
    if (seen.id != by.id) continue;
    const std::uint32_t sum = SumOfCounts(seen.count, by.count);
    if (entry.is_wide == 0 && sum > kMostNarrow) return false;
    Put(entry, i, {seen.id, sum});
    return true;
  }
  return false;
}

void LabelLists::AddObservation(std::uint32_t number, ClassId c, std::uint32_t count) {
  const Entry& entry = entries_[number];
  if (Raise(entry, entry.num_classes, entry.size(), {kOwnInstance.code(), count})) {
    if (Raise(entry, 0, entry.num_classes, {c.value, count})) return;
    LabelHistograms all = Get(number);  // includes the instance's count
    all.classes = SumCounts(all.classes, LabelHistograms::OfClass(c, count).classes);
    return Set(number, all);
  }
  const LabelHistograms before = Get(number), added = LabelHistograms::OfClass(c, count);
  Set(number, {SumCounts(before.classes, added.classes), SumCounts(before.instances, added.instances)});
}

LabelHistograms LabelLists::Get(std::uint32_t number) const {
  LabelHistograms histograms;
  histograms.classes.reserve(entries_[number].num_classes);
  histograms.instances.reserve(entries_[number].num_instances);
  VisitClasses(number, [&](const LabelCount& seen) { histograms.classes.push_back(seen); });
  VisitInstances(number, [&](const InstanceCount& seen) { histograms.instances.push_back(seen); });
  return histograms;
}

bool LabelLists::HasInstance(SeenInstance instance) const {
  bool has_it = false;
  for (std::uint32_t i = 0; i < entries_.size() && !has_it; ++i) {
    VisitInstances(i, [&](const InstanceCount& seen) { has_it = has_it || seen.id == instance; });
  }
  return has_it;
}

void LabelLists::RenameInstance(SeenInstance from, SeenInstance to) {
  for (std::uint32_t i = 0; i < entries_.size(); ++i) {
    LabelHistograms all = Get(i);
    const auto found = std::find_if(all.instances.begin(), all.instances.end(),
                                    [from](const InstanceCount& seen) { return seen.id == from; });
    if (found == all.instances.end()) continue;
    const InstanceCount renamed{to, found->count};
    all.instances.erase(found);
    all.instances = SumCounts(all.instances, std::vector<InstanceCount>{renamed});
    Set(i, all);
  }
}

void LabelLists::Shrink() {
  if (num_unused_ > 0 || words_.size() < words_.capacity()) Compact(0);
  entries_.shrink_to_fit();
  free_.shrink_to_fit();
}

std::size_t LabelLists::MemoryBytes() const {
  return entries_.capacity() * sizeof(Entry) + free_.capacity() * sizeof(std::uint32_t) +
         words_.capacity() * sizeof(std::uint16_t);
}

void LabelLists::Compact(std::size_t num_more) {
  const std::size_t num_used = words_.size() - num_unused_;
  std::vector<std::uint16_t> words;
  words.reserve(num_more > 0 ? WithSlack(num_used + num_more) : num_used);
  for (Entry& entry : entries_) {
    const auto begin = words_.begin() + static_cast<std::ptrdiff_t>(entry.first);
    entry.first = static_cast<std::uint32_t>(words.size()) & 0x7FFFFFFFu;
    words.insert(words.end(), begin, begin + static_cast<std::ptrdiff_t>(entry.num_words()));
  }
  words_ = std::move(words);
  num_unused_ = 0;
}

}  // namespace dhpmap
