// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/label_lists.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace dhpmap {
namespace {

constexpr std::uint32_t kLarge = 70'000;

std::uint32_t DrawBelow(std::mt19937& random, std::uint32_t below) {
  return static_cast<std::uint32_t>(random()) % below;
}

/// Up to four classes and instances each, now and then with a large id or count.
LabelHistograms RandomLists(std::mt19937& random) {
  std::map<std::uint32_t, std::uint32_t> classes, instances;
  const auto count = [&random] { return DrawBelow(random, 20) == 0 ? kLarge : 1 + DrawBelow(random, 100); };
  for (std::uint32_t n = DrawBelow(random, 5); n > 0; --n) classes[DrawBelow(random, 9)] = count();
  for (std::uint32_t n = DrawBelow(random, 5); n > 0; --n)
    instances[DrawBelow(random, 30) == 0 ? kLarge : DrawBelow(random, 6)] = count();
  LabelHistograms histograms;
  for (const auto& entry : classes) histograms.classes.push_back({entry.first, entry.second});
  for (const auto& entry : instances) {
    histograms.instances.push_back({SeenInstance::FromCode(entry.first), entry.second});
  }
  return histograms;
}

/// The same as LabelLists does, the obvious way.
struct NaiveLists {
  std::map<std::uint32_t, LabelHistograms> entries;

  void AddObservation(std::uint32_t entry, ClassId c, std::uint32_t count) {
    LabelHistograms& all = entries.at(entry);
    const LabelHistograms added = LabelHistograms::OfClass(c, count);
    all = {SumCounts(all.classes, added.classes), SumCounts(all.instances, added.instances)};
  }
  void RenameInstance(SeenInstance from, SeenInstance to) {
    for (auto& entry : entries) {
      std::vector<InstanceCount> kept, moved;
      for (const InstanceCount& seen : entry.second.instances) {
        if (seen.id == from) moved.push_back({to, seen.count});
        else kept.push_back(seen);
      }
      entry.second.instances = SumCounts(kept, moved);
    }
  }
};

TEST(LabelLists, HoldWhatWasPutInThroughAnyMixOfChanges) {
  std::mt19937 random(4);
  LabelLists lists;
  NaiveLists naive;
  for (int step = 0; step < 4000; ++step) {
    const std::uint32_t kind = DrawBelow(random, 8);
    auto at = naive.entries.lower_bound(DrawBelow(random, 60));
    if (kind < 3 || at == naive.entries.end()) {
      const LabelHistograms added = RandomLists(random);
      const std::uint32_t entry = lists.Add(added);
      ASSERT_EQ(naive.entries.count(entry), 0u);
      naive.entries[entry] = added;
    } else if (kind < 5) {
      lists.Remove(at->first);
      naive.entries.erase(at);
    } else if (kind == 5) {
      at->second = RandomLists(random);
      lists.Set(at->first, at->second);
    } else if (kind == 6) {
      const ClassId c(static_cast<std::uint16_t>(DrawBelow(random, 9)));
      const std::uint32_t count = DrawBelow(random, 10) == 0 ? 65'530 : 1;
      lists.AddObservation(at->first, c, count);
      naive.AddObservation(at->first, c, count);
    } else if (step % 100 == 7) {
      lists.RenameInstance(SeenInstance(SubmapId(3)), SeenInstance(SubmapId(kLarge)));
      naive.RenameInstance(SeenInstance(SubmapId(3)), SeenInstance(SubmapId(kLarge)));
      lists.Shrink();
    }
    ASSERT_EQ(lists.NumEntries(), naive.entries.size());
    if (step % 40 != 0) continue;
    bool has_large = false;
    for (const auto& entry : naive.entries) {
      ASSERT_EQ(lists.Get(entry.first), entry.second) << "step " << step << ", entry " << entry.first;
      for (const InstanceCount& seen : entry.second.instances) has_large = has_large || seen.id.code() == kLarge;
    }
    EXPECT_EQ(lists.HasInstance(SeenInstance::FromCode(kLarge)), has_large);
  }
}

TEST(LabelLists, TakeEightBytesAVoxelAndFourACount) {
  LabelLists lists;
  const LabelHistograms usual{{{3, 40}, {5, 2}}, {{kOwnInstance, 41}, {SeenInstance(SubmapId(9)), 1}}};
  for (int i = 0; i < 300; ++i) lists.Add(usual);
  EXPECT_LE(lists.MemoryBytes(), 300u * 24 * 5 / 4) << "with room to grow";
  lists.Shrink();
  EXPECT_EQ(lists.MemoryBytes(), 300u * 24);
}

TEST(LabelLists, UseTheRoomOfRemovedEntriesAgain) {
  LabelLists lists;
  const LabelHistograms usual{{{3, 40}}, {{kOwnInstance, 41}, {SeenInstance(SubmapId(9)), 1}}};
  for (int i = 0; i < 100; ++i) lists.Add(usual);
  const std::size_t bytes = lists.MemoryBytes();
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    lists.Remove(i % 100);
    EXPECT_EQ(lists.Add(usual), i % 100);
  }
  EXPECT_LE(lists.MemoryBytes(), bytes * 5 / 4);
}

}  // namespace
}  // namespace dhpmap
