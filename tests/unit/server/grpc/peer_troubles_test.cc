// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/peer_troubles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

namespace dhpmap {
namespace {

std::ptrdiff_t NumLinesOf(const std::function<void()>& work) {
  ::testing::internal::CaptureStderr();
  work();
  const std::string log = ::testing::internal::GetCapturedStderr();
  return std::count(log.begin(), log.end(), '\n');
}

TEST(PeerTroublesTest, LogsALineForEachAddressAndPause) {
  PeerTroubles::Clock::time_point now;
  PeerTroubles troubles([&] { return now; });
  const auto note_both = [&] {
    for (int i = 0; i < 100; ++i) {
      troubles.Note("a:1", "refused");
      troubles.Note("b:1", i % 2 == 0 ? "reset" : "refused");
    }
  };
  EXPECT_EQ(NumLinesOf(note_both), 2);
  now += PeerTroubles::kPause - std::chrono::seconds(1);
  EXPECT_EQ(NumLinesOf(note_both), 0);
  now += std::chrono::seconds(1);
  EXPECT_EQ(NumLinesOf(note_both), 2);
}

TEST(PeerTroublesTest, RemembersABoundedNumberOfAddresses) {
  PeerTroubles::Clock::time_point now;
  PeerTroubles troubles([&] { return now; });
  EXPECT_EQ(NumLinesOf([&] {
              for (int i = 0; i < 1000; ++i) troubles.Note("host:" + std::to_string(i), "refused");
            }),
            static_cast<std::ptrdiff_t>(PeerTroubles::kMostPeers) + 1);
}

}  // namespace
}  // namespace dhpmap
