// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/label_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace dhpmap {
namespace {

using Counts = std::map<std::uint32_t, std::uint64_t>;

/// The same thing, slow and obvious.
struct NaiveVoxel {
  Counts classes, instances;

  void Add(const LabelHistograms& h) {
    for (const LabelCount& entry : h.classes) classes[entry.id] += entry.count;
    for (const InstanceCount& entry : h.instances) instances[entry.id.code()] += entry.count;
  }
};

std::vector<LabelCount> ToList(const Counts& counts) {
  std::vector<LabelCount> list;
  for (const auto& [id, count] : counts) list.push_back({id, static_cast<std::uint32_t>(count)});
  return list;
}

std::vector<InstanceCount> ToInstances(const Counts& counts) {
  std::vector<InstanceCount> list;
  for (const LabelCount& entry : ToList(counts)) list.push_back({SeenInstance::FromCode(entry.id), entry.count});
  return list;
}

BestLabel NaiveBest(const Counts& counts) {
  BestLabel best;
  std::uint64_t total = 0;
  for (const auto& [id, count] : counts) {
    total += count;
    if (count > best.count) best = {id, static_cast<std::uint32_t>(count), 0};
  }
  if (total > 0) best.share = static_cast<float>(best.count) / static_cast<float>(total);
  return best;
}

void ExpectSame(const BestLabel& a, const BestLabel& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.count, b.count);
  EXPECT_FLOAT_EQ(a.share, b.share);
}

void ExpectSame(const LabelBlock& block, int linear, const NaiveVoxel& naive) {
  EXPECT_EQ(block.Get(linear), (LabelHistograms{ToList(naive.classes), ToInstances(naive.instances)}));
  EXPECT_EQ(block.IsEmpty(linear), naive.classes.empty() && naive.instances.empty());
  ExpectSame(block.BestClass(linear), NaiveBest(naive.classes));
  const auto best = block.BestInstance(linear);
  ExpectSame({best.id.code(), best.count, best.share}, NaiveBest(naive.instances));
  std::uint64_t total = 0;
  for (const auto& [id, count] : naive.instances) total += count;
  EXPECT_EQ(block.NumObservations(linear), total);
}

/// One that a fused, merged or loaded voxel could have: few labels or many, counts small, around 65,535 or huge.
LabelHistograms RandomHistograms(std::mt19937& random) {
  const std::uint32_t bases[] = {1, 5, 65'530, 65'534, 65'535, 65'536, 1'000'000};
  const auto count = [&] { return bases[random() % 7] + static_cast<std::uint32_t>(random() % 3); };
  Counts classes, instances;
  std::uint64_t total = 0;
  for (std::size_t i = random() % 5; i > 0; --i)
    classes[random() % 2 != 0 ? random() % 4 : random() % 65'535] = count();
  for (const auto& [id, n] : classes) total += n;
  if (random() % 2 != 0 && total > 0) instances[0] = total;  // what observations of the own submap add up to
  else
    for (std::size_t i = random() % 4; i > 0; --i) instances[static_cast<std::uint32_t>(random() % 1000)] = count();
  return {ToList(classes), ToInstances(instances)};
}

TEST(LabelBlock, AgreesWithANaiveOneUnderRandomOperations) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    LabelBlock block;
    std::map<int, NaiveVoxel> naive;
    const int voxels[] = {0, 1, 255, 511};
    for (int step = 0; step < 400; ++step) {
      const int linear = voxels[random() % 4];
      switch (random() % 8) {
        case 0: {
          const LabelHistograms h = RandomHistograms(random);
          block.Set(linear, h);
          naive[linear] = {};
          naive[linear].Add(h);
          break;
        }
        case 1: {
          const LabelHistograms h = RandomHistograms(random);
          block.Add(linear, h);
          naive[linear].Add(h);
          break;
        }
        case 2:
          if (random() % 4 != 0) break;
          block.Clear(linear);
          naive[linear] = {};
          break;
        default: {
          const auto c = static_cast<std::uint16_t>(random() % 3);
          for (std::size_t n = random() % 6; n > 0; --n) {
            block.AddObservation(linear, ClassId(c));
            naive[linear].Add({{{c, 1}}, {{kOwnInstance, 1}}});
          }
        }
      }
      ExpectSame(block, linear, naive[linear]);
    }
    for (const int linear : voxels) ExpectSame(block, linear, naive[linear]);
    EXPECT_TRUE(block.IsEmpty(300)) << "a voxel that nobody touched";
  }
}

/// Whichever way one class comes to a block, until another one does, or more than two bytes can count.
TEST(LabelBlock, OfOneClassAgreesWithANaiveOneUntilAnotherComes) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::uint16_t usual = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 7 : 65'534;
    LabelBlock block;
    std::map<int, NaiveVoxel> naive;
    std::size_t most_bytes = 0;
    for (int step = 0; step < 300; ++step) {
      const int linear = static_cast<int>(random() % 6) * 100;
      const std::uint16_t c = random() % 100 == 0 ? 3 : usual;
      const std::uint32_t count = random() % 20 == 0 ? 40'000 : 1 + random() % 300;
      const LabelHistograms h = LabelHistograms::OfClass(ClassId(c), count);
      NaiveVoxel& expected = naive[linear];
      const bool is_first = expected.classes.empty();
      switch (random() % 5) {
        case 0:
          block.Set(linear, h);
          expected = {};
          expected.Add(h);
          break;
        case 1:
          block.Add(linear, h);
          expected.Add(h);
          break;
        case 2:
          if (!is_first) break;
          block.SetFirst(linear, h.classes[0]);
          expected.Add(h);
          break;
        case 3:
          block.Clear(linear);
          expected = {};
          break;
        default: block.AddObservation(linear, ClassId(c), count); expected.Add(h);
      }
      for (const auto& [voxel, of_voxel] : naive) ExpectSame(block, voxel, of_voxel);
      if (step % 50 == 0) {
        LabelBlock assigned;
        if (random() % 2 == 0) assigned.Set(0, {{{1, 1}, {2, 1}}, {{kOwnInstance, 2}}});
        assigned = block;
        EXPECT_TRUE(assigned == block && LabelBlock(block) == block);
        EXPECT_EQ(assigned.CountedBytes(), block.CountedBytes());
      }
      EXPECT_GE(block.MemoryBytes(), most_bytes) << "cells stay";
      most_bytes = block.CountedBytes();
      if (HasFailure()) FAIL() << "seed " << seed << ", step " << step;
    }
  }
}

TEST(LabelBlock, TotalsAreThoseOfAllVoxelsWithoutTheClassesOfWhatIsConcluded) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const bool is_of_one_class = seed % 2 == 0;
    std::mt19937 random(seed);
    LabelBlock block;
    std::map<std::uint32_t, std::uint64_t> classes;
    std::uint64_t own = 0, all = 0;
    for (int linear = 0; linear < kBlockVoxels; linear += 1 + static_cast<int>(random() % 5)) {
      LabelHistograms seen = RandomHistograms(random);
      if (random() % 2 == 0)
        seen = {{{static_cast<std::uint32_t>(1 + random() % 3), 7}}, {{kOwnInstance, 7}}};  // inline
      if (is_of_one_class)
        seen = LabelHistograms::OfClass(ClassId(9), 1 + static_cast<std::uint32_t>(random() % 65'535));
      block.Set(linear, seen);
      const bool is_concluded = random() % 3 == 0;
      block.SetConcluded(linear, is_concluded);
      for (const LabelCount& c : seen.classes) classes[c.id] += is_concluded ? 0 : c.count;
      for (const InstanceCount& c : seen.instances) {
        all += c.count;
        own += c.id.IsOwn() ? c.count : 0;
      }
    }
    EXPECT_EQ(block.CountedBytes(), (is_of_one_class ? 2u : 8u) * kBlockVoxels);
    LabelTotals totals;
    block.AddTo(totals);
    EXPECT_EQ(totals.own, own);
    EXPECT_EQ(totals.instances, all);
    for (std::size_t id = 0; id < totals.classes.size(); ++id) {
      EXPECT_EQ(totals.classes[id], classes[static_cast<std::uint32_t>(id)]);
      classes.erase(static_cast<std::uint32_t>(id));
    }
    for (const auto& [id, count] : classes) EXPECT_EQ(count, 0u) << id;
  }
}

TEST(LabelBlock, CountsOnBeyond65535) {
  LabelBlock block;
  for (int i = 0; i < 65'535; ++i) block.AddObservation(7, ClassId(4));
  for (int i = 0; i < 10; ++i) block.AddObservation(7, ClassId(4));
  EXPECT_EQ(block.NumOverflowVoxels(), 0u) << "a class alone may be seen so often";
  EXPECT_EQ(block.Get(7), (LabelHistograms{{{4, 65'545}}, {{kOwnInstance, 65'545}}}));
}

TEST(LabelBlock, AnObservationMayCountMoreThanOneAndAddsUpInAnyOrder) {
  std::mt19937 random(5);
  std::vector<std::pair<std::uint16_t, std::uint32_t>> seen;
  seen.reserve(2000);
  for (int i = 0; i < 2000; ++i) {
    seen.emplace_back(static_cast<std::uint16_t>(random() % 3), 1 + static_cast<std::uint32_t>(random() % 256));
  }
  NaiveVoxel naive;
  for (const auto& [c, count] : seen) naive.Add(LabelHistograms::OfClass(ClassId(c), count));
  for (int order = 0; order < 3; ++order) {
    LabelBlock block;
    for (const auto& [c, count] : seen) block.AddObservation(9, ClassId(c), count);
    ExpectSame(block, 9, naive);
    std::shuffle(seen.begin(), seen.end(), random);
  }
  LabelBlock full;
  full.AddObservation(1, ClassId(4), 65'535);
  EXPECT_EQ(full.NumOverflowVoxels(), 0u);
  full.AddObservation(1, ClassId(4), 65'535);
  EXPECT_EQ(full.Get(1), LabelHistograms::OfClass(ClassId(4), 131'070));
}

TEST(LabelBlock, OneClassCountsInlineUpTo32BitsAndEndsThere) {
  LabelBlock block;
  NaiveVoxel naive;
  for (int i = 0; i < 3000; ++i) {
    block.AddObservation(3, ClassId(65'534), 256);
    naive.Add(LabelHistograms::OfClass(ClassId(65'534), 256));
    if (i % 64 < 3) ExpectSame(block, 3, naive);
  }
  block.Set(4, LabelHistograms::OfClass(ClassId(7), 0x20000));  // whose lower half is 0
  EXPECT_FALSE(block.IsEmpty(4));
  block.AddObservation(4, ClassId(7));
  EXPECT_EQ(block.Get(4), LabelHistograms::OfClass(ClassId(7), 0x20001));
  EXPECT_EQ(block.NumOverflowVoxels(), 0u);
  LabelTotals totals;
  block.AddTo(totals);
  EXPECT_EQ(totals.classes[7], 0x20001u);
  EXPECT_EQ(totals.own, 0x20001u + 3000u * 256u);
  block.AddObservation(4, ClassId(9));  // a second class
  EXPECT_EQ(block.Get(4), (LabelHistograms{{{7, 0x20001}, {9, 1}}, {{kOwnInstance, 0x20002}}}));
  block.Set(5, LabelHistograms::OfClass(ClassId(7), 0xFFFFFFF0));
  for (int i = 0; i < 3; ++i) block.AddObservation(5, ClassId(7), 256);
  EXPECT_EQ(block.Get(5), LabelHistograms::OfClass(ClassId(7), 0xFFFFFFFF));
}

TEST(LabelBlock, SecondClassCountsOnBeyond65535Too) {
  LabelBlock block;
  block.AddObservation(7, ClassId(4));
  for (int i = 0; i < 70'000; ++i) block.AddObservation(7, ClassId(2));
  EXPECT_EQ(block.Get(7), (LabelHistograms{{{2, 70'000}, {4, 1}}, {{kOwnInstance, 70'001}}}));
}

TEST(LabelBlock, KeepsOneOrTwoClassesInlineAndAThirdInOverflow) {
  LabelBlock block;
  EXPECT_GE(block.MemoryBytes(), 2u * kBlockVoxels) << "with the counts, which have an allocation of their own";
  EXPECT_LE(block.MemoryBytes(), 2u * kBlockVoxels + 192);
  block.AddObservation(7, ClassId(9));
  block.AddObservation(8, ClassId(9));
  EXPECT_EQ(block.CountedBytes(), 2u * kBlockVoxels) << "one class";
  block.Clear(7);
  block.Clear(8);
  block.AddObservation(0, ClassId(9));
  block.AddObservation(0, ClassId(3));
  block.Clear(0);
  const std::size_t empty_bytes = block.MemoryBytes();
  EXPECT_EQ(block.CountedBytes(), 8u * kBlockVoxels) << "two";
  EXPECT_LE(empty_bytes, 8u * kBlockVoxels + 192);
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    block.AddObservation(linear, ClassId(9));
    block.AddObservation(linear, ClassId(3));
  }
  EXPECT_EQ(block.NumOverflowVoxels(), 0u);
  EXPECT_EQ(block.MemoryBytes(), empty_bytes);
  block.AddObservation(100, ClassId(5));
  EXPECT_EQ(block.NumOverflowVoxels(), 1u);
  EXPECT_GT(block.MemoryBytes(), empty_bytes);
  EXPECT_EQ(block.Get(100), (LabelHistograms{{{3, 1}, {5, 1}, {9, 1}}, {{kOwnInstance, 3}}}));
  EXPECT_EQ(block.Get(101), (LabelHistograms{{{3, 1}, {9, 1}}, {{kOwnInstance, 2}}}));
}

TEST(LabelBlock, OverflowPlacesAreUsedAgain) {
  LabelBlock block;
  const LabelHistograms foreign{{{1, 2}}, {{kOwnInstance, 1}, {SeenInstance(SubmapId(33)), 1}}};
  block.Set(0, foreign);
  const std::size_t bytes = block.MemoryBytes();
  for (int i = 0; i < 1000; ++i) {
    block.Clear(i % kBlockVoxels);
    EXPECT_EQ(block.NumOverflowVoxels(), 0u);
    block.Set((i + 1) % kBlockVoxels, foreign);
    EXPECT_EQ(block.Get((i + 1) % kBlockVoxels), foreign);
  }
  EXPECT_LE(block.MemoryBytes(), bytes + 64);
}

TEST(LabelBlock, KeepsHistogramsWithZeroCountsAsTheyAre) {
  for (const bool is_of_one_class : {true, false}) {
    LabelBlock block;
    if (!is_of_one_class) block.Set(9, {{{1, 1}, {2, 1}}, {{kOwnInstance, 2}}});
    const LabelHistograms zero{{{5, 0}}, {{kOwnInstance, 0}}};
    block.Set(3, zero);
    EXPECT_EQ(block.Get(3), zero);
    EXPECT_FALSE(block.IsEmpty(3));
  }

  LabelBlock block;
  const LabelHistograms odd{{{1, 0}, {2, 5}}, {{kOwnInstance, 5}}};
  block.Set(0, odd);
  EXPECT_FALSE(block.IsEmpty(0));
  EXPECT_EQ(block.Get(0), odd);
  EXPECT_EQ(block.BestClass(0).id, 2u);
}

TEST(LabelBlock, TiesGoToTheSmallerClassAndToTheOwnInstance) {
  LabelBlock block;
  block.AddObservation(0, ClassId(9));
  block.AddObservation(0, ClassId(3));
  EXPECT_EQ(block.BestClass(0).id, 3u);
  EXPECT_FLOAT_EQ(block.BestClass(0).share, 0.5f);
  block.Set(1, {{{3, 4}}, {{kOwnInstance, 2}, {SeenInstance(SubmapId(12)), 2}}});
  EXPECT_EQ(block.BestInstance(1).id, kOwnInstance);
  EXPECT_EQ(block.BestInstance(2).count, 0u);
}

TEST(LabelBlock, CopiesAreIndependentAndEqualByContent) {
  LabelBlock a;
  for (int i = 0; i < 3; ++i) a.AddObservation(5, ClassId(static_cast<std::uint16_t>(i)));
  LabelBlock b = a;
  EXPECT_EQ(a, b);
  b.AddObservation(5, ClassId(1));
  EXPECT_FALSE(a == b);
  EXPECT_EQ(a.NumObservations(5), 3u);
  // The same counts by another road: in the overflow list or inline does not matter.
  LabelBlock c;
  c.Set(5, b.Get(5));
  c.Set(6, {{{1, 1}}, {{SeenInstance(SubmapId(7)), 1}}});
  c.Clear(6);
  EXPECT_EQ(b, c);
}

TEST(LabelBlock, WhatIsConcludedChangesNoCountsAndEndsWhereTheyAreReplaced) {
  LabelBlock seen;
  for (int n = 0; n < 3; ++n) seen.AddObservation(5, ClassId(2));
  seen.Set(6, {{{1, 4}}, {{SeenInstance(SubmapId(9)), 4}}});
  LabelBlock block = seen;
  block.SetConcluded(5, true);
  block.SetConcluded(6, true);
  EXPECT_FALSE(block == seen);
  for (const int i : {4, 5, 6, 7}) {
    EXPECT_EQ(block.IsConcluded(i), i == 5 || i == 6);
    EXPECT_EQ(block.Get(i), seen.Get(i));
    EXPECT_EQ(block.BestInstance(i).id, seen.BestInstance(i).id);
  }
  block.AddObservation(5, ClassId(2));
  block.Add(6, {{{1, 1}}, {{SeenInstance(SubmapId(9)), 1}}});
  EXPECT_TRUE(block.IsConcluded(5) && block.IsConcluded(6)) << "more of what was seen takes back nothing by itself";
  block.Clear(5);
  block.Set(6, seen.Get(6));
  EXPECT_TRUE(HasNone(block.concluded()));
}

TEST(SumCounts, MergesListsAndConservesTotals) {
  const std::vector<LabelCount> none;
  EXPECT_EQ(SumCounts(none, none), none);
  const std::vector<LabelCount> a = {{1, 2}, {5, 1}, {9, 4}}, b = {{0, 1}, {5, 6}};
  EXPECT_EQ(SumCounts(a, b), (std::vector<LabelCount>{{0, 1}, {1, 2}, {5, 7}, {9, 4}}));
  EXPECT_EQ(SumCounts(a, b), SumCounts(b, a));
}

}  // namespace
}  // namespace dhpmap
