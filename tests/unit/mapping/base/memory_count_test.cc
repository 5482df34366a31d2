// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/memory_count.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

constexpr MemoryKind kKind = MemoryKind::kFusion;  // nothing else here counts it

std::size_t Now() { return CountOf(kKind).now_bytes(); }

TEST(MemoryCountTest, TellsWhatThereIsAndWhatThereWasAtMost) {
  MemoryCount count;
  count.Add(70);
  count.Add(30);
  count.Remove(60);
  count.Add(20);
  EXPECT_EQ(count.now_bytes(), 60u);
  EXPECT_EQ(count.most_bytes(), 100u);
  count.Remove(60);
  EXPECT_EQ(count.now_bytes(), 0u);
  EXPECT_EQ(count.most_bytes(), 100u);
}

TEST(MemoryCountTest, LosesNothingOfManyThreads) {
  MemoryCount count;
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 1; t <= 4; ++t) {
      threads.emplace_back([&count, t] {
        for (int i = 0; i < 5000; ++i) {
          count.Add(3 * t);
          count.Remove(2 * t);
        }
      });
    }
  }
  EXPECT_EQ(count.now_bytes(), 5000u * (1 + 2 + 3 + 4));
  EXPECT_GE(count.most_bytes(), count.now_bytes());
}

TEST(MemoryCountTest, KindsAreCountedApart) {
  const std::size_t other = CountOf(MemoryKind::kMeshing).now_bytes();
  const CountedBytes bytes(kKind, 5);
  EXPECT_EQ(Now(), 5u);
  EXPECT_EQ(CountOf(MemoryKind::kMeshing).now_bytes(), other);
}

TEST(CountedBytesTest, CountWhatTheirOwnerSaysUntilTheyEnd) {
  {
    CountedBytes bytes(kKind);
    EXPECT_EQ(Now(), 0u);
    bytes.Set(1000);
    EXPECT_EQ(Now(), 1000u);
    bytes.Set(10);
    EXPECT_EQ(Now(), 10u);
    const CountedBytes moved(std::move(bytes));
    EXPECT_EQ(Now(), 10u);
    EXPECT_EQ(moved.bytes(), 10u);
  }
  EXPECT_EQ(Now(), 0u);
}

TEST(CountedBytesTest, ALargerNumberIsNoPeakOfBothTogether) {
  CountedBytes bytes(kKind, 100'000'000);
  const std::size_t most = CountOf(kKind).most_bytes();
  bytes.Set(100'000'001);
  EXPECT_EQ(CountOf(kKind).most_bytes(), most + 1);
}

TEST(CountedVectorTest, CountsRoomThatIsNotUsedYet) {
  {
    CountedVector<double, kKind> numbers;
    EXPECT_EQ(Now(), 0u);
    numbers.reserve(100);
    numbers.push_back(1);
    EXPECT_EQ(Now(), 100 * sizeof(double));
    EXPECT_EQ(CapacityBytes(numbers), Now());
    for (int i = 0; i < 1000; ++i) numbers.push_back(i);
    EXPECT_EQ(Now(), numbers.capacity() * sizeof(double));
    const CountedVector<double, kKind> copy = numbers;
    EXPECT_EQ(Now(), (numbers.capacity() + copy.capacity()) * sizeof(double));
    CountedVector<double, kKind> moved = std::move(numbers);
    EXPECT_EQ(Now(), (moved.capacity() + copy.capacity()) * sizeof(double));
    moved.clear();
    moved.shrink_to_fit();
    EXPECT_EQ(Now(), CapacityBytes(copy));
  }
  EXPECT_EQ(Now(), 0u);
}

TEST(CountedVectorTest, AnExceptionInTheMiddleLeavesNothingCounted) {
  struct ThrowsWhenCopied {
    int number = 0;
    explicit ThrowsWhenCopied(int n) : number(n) {}
    ThrowsWhenCopied(const ThrowsWhenCopied& other) : number(other.number) {
      if (number == 3) throw std::runtime_error("3");
    }
    ThrowsWhenCopied& operator=(const ThrowsWhenCopied&) = default;
    ~ThrowsWhenCopied() = default;
  };
  const auto fill = [] {
    CountedVector<ThrowsWhenCopied, kKind> items;
    for (int i = 0; i < 10; ++i) items.emplace_back(i);  // copies those there are when it grows
  };
  EXPECT_THROW(fill(), std::runtime_error);
  EXPECT_EQ(Now(), 0u);
}

TEST(CountedAllocatorTest, WhatCannotBeAllocatedIsNotCounted) {
  CountedAllocator<double, kKind> allocator;
  EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
  EXPECT_EQ(Now(), 0u);
}

TEST(CountedAllocatorTest, CountsNodesAndBucketsOfAHashTable) {
  using Pair = std::pair<const int, std::string>;
  {
    std::unordered_map<int, std::string, std::hash<int>, std::equal_to<>, CountedAllocator<Pair, kKind>> table;
    for (int i = 0; i < 1000; ++i) table.emplace(i, "x");
    EXPECT_GE(Now(), 1000 * sizeof(Pair) + table.bucket_count() * sizeof(void*));
    EXPECT_LE(Now(), 1000 * (sizeof(Pair) + 32) + table.bucket_count() * sizeof(void*));
  }
  EXPECT_EQ(Now(), 0u);
}

struct Counted {
  std::array<char, 100> content{};
  static void* operator new(std::size_t bytes) { return NewCounted(kKind, bytes, bytes); }
  static void operator delete(void* object, std::size_t bytes) { DeleteCounted(kKind, object, bytes); }
};

TEST(NewCountedTest, CountsObjectsThatAreMadeByNewAloneAndSharedOnesUntilTheLastLetsGo) {
  const Counted on_the_stack;
  const auto in_another_allocation = std::make_shared<Counted>();
  EXPECT_EQ(Now(), 0u);
  const auto alone = std::make_unique<Counted>();
  std::shared_ptr<const Counted> shared(new Counted(on_the_stack));
  const std::weak_ptr<const Counted> mark = shared;
  EXPECT_EQ(Now(), 2 * sizeof(Counted));
  shared = nullptr;
  EXPECT_EQ(Now(), sizeof(Counted)) << "a mark keeps no object";
}

}  // namespace
}  // namespace dhpmap
