// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/stream_window.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace dhpmap {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

TEST(StreamWindow, OfManyStreamsFitsBesideTheBudget) {
  for (const std::size_t budget_mib : {96u, 192u, 1000u, 3000u}) {
    const auto window_bytes = static_cast<std::size_t>(StreamWindow_bytes(budget_mib * kMebibyte));
    EXPECT_LE(256 * window_bytes, budget_mib * kMebibyte / 3) << budget_mib;
  }
}

TEST(StreamWindow, IsAPartOfAFileByDefault) { EXPECT_EQ(StreamWindow_bytes(192 * kMebibyte), 256 << 10); }

TEST(StreamWindow, IsBetweenTheProtocolsDefaultAndAMebibyte) {
  EXPECT_EQ(StreamWindow_bytes(0), 65'535);
  EXPECT_EQ(StreamWindow_bytes(12 * kMebibyte), 65'535);
  EXPECT_EQ(StreamWindow_bytes(SIZE_MAX), static_cast<int>(kMebibyte));
}

}  // namespace
}  // namespace dhpmap
