// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/peer_slots.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dhpmap {
namespace {

TEST(PeerSlots, GiveEachOfTheFirstPeersItsOwnSlot) {
  PeerSlots slots;
  std::set<std::size_t> given;
  for (std::size_t i = 1; i < PeerSlots::kNum; ++i) {
    const std::string peer = "192.0.2." + std::to_string(i);
    const std::size_t slot = slots.Of(peer);
    EXPECT_TRUE(given.insert(slot).second);
    EXPECT_EQ(slots.Of(peer), slot) << "again";
    EXPECT_EQ(slots.KeyOf(slot), peer);
  }
  EXPECT_FALSE(given.contains(0)) << "which is for those without an address";
  EXPECT_EQ(slots.Of(""), 0u);
  EXPECT_EQ(slots.KeyOf(0), "");
  const std::size_t shared = slots.Of("198.51.100.1");
  EXPECT_TRUE(given.contains(shared));
  EXPECT_EQ(slots.KeyOf(shared), "slot " + std::to_string(shared)) << "is no address's any more";
}

TEST(PeerSlots, DropPeersBeyondTheirLimit) {
  PeerSlots slots;
  for (std::size_t i = 0; i < 3 * PeerSlots::kMostPeers; ++i) {
    const std::size_t slot = slots.Of("peer " + std::to_string(i));
    EXPECT_TRUE(slot > 0 && slot < PeerSlots::kNum);
  }
}

}  // namespace
}  // namespace dhpmap
