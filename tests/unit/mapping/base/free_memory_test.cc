// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/free_memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace dhpmap {
namespace {

#if !defined(DHPMAP_SANITIZED)  // whose allocators keep what is free, to find who still uses it

long AnonymousKiB() {
  std::ifstream status("/proc/self/status");
  std::string key;
  long kib = 0;
  while (status >> key) {
    if (key == "RssAnon:") status >> kib;
  }
  return kib;
}

TEST(GiveBackFreeMemoryTest, WhatIsFreeBetweenWhatIsUsedGoesBackToTheSystem) {
  constexpr std::size_t kBytes = 16384, kCount = 4096;
  std::vector<std::unique_ptr<char[]>> all;
  for (std::size_t i = 0; i < kCount; ++i) all.push_back(std::make_unique<char[]>(kBytes));
  for (std::size_t i = 0; i < kCount; ++i) {
    if (i % 64 != 0) all[i].reset();  // what stays keeps the heap from shrinking by itself
  }
  const long before_kib = AnonymousKiB();
  GiveBackFreeMemory();
  EXPECT_GT(before_kib - AnonymousKiB(), 40 * 1024);
  for (std::size_t i = 0; i < kCount; i += 64) EXPECT_EQ(all[i][kBytes - 1], 0);
}

#endif

TEST(GiveBackFreeMemoryTest, MayBeCalledAtAnyTime) {
  GiveBackFreeMemory();
  GiveBackFreeMemory();
}

}  // namespace
}  // namespace dhpmap
