// SPDX-License-Identifier: BSD-3-Clause
// The C++ library finds a map's owner by itself, and returns to its first server when the owner is gone.
#include <gtest/gtest.h>

#include "dhpmap/client.h"
#include "tests/integration/fleet/fleet_of_two.h"

namespace dhpmap::testing {
namespace {

client::Client ConnectTo(FleetMember& member, bool to_owner) {
  auto connected = client::Client::Connect(member.address(), {.to_owner = to_owner});
  EXPECT_OK(connected);
  return *std::move(connected);
}

TEST_F(FleetOfTwo, AClientCallsTheOwnerDirectlyOnceItIsKnown) {
  const client::Client connection = ConnectTo(other, true);
  const auto map = connection.OpenMap("room");
  ASSERT_OK(map);
  EXPECT_GE(num_relayed, 1);
  EXPECT_TRUE(Eventually([&] {
    const int before = num_relayed;
    EXPECT_OK(map->Info());
    return num_relayed == before;
  })) << "as soon as it is connected there";
}

TEST_F(FleetOfTwo, AClientWithoutRoutingStaysAtItsServer) {
  const client::Client connection = ConnectTo(other, false);
  const auto map = connection.OpenMap("room");
  ASSERT_OK(map);
  for (int i = 0; i < 3; ++i) {
    const int before = num_relayed;
    EXPECT_OK(map->Info());
    EXPECT_EQ(num_relayed, before + 1);
  }
}

TEST_F(FleetOfTwo, AClientReturnsToItsServerWhenTheOwnerIsGone) {
  const client::Client connection = ConnectTo(other, true);
  const auto map = connection.OpenMap("room");
  ASSERT_OK(map);
  EXPECT_TRUE(Eventually([&] {
    const int before = num_relayed;
    EXPECT_OK(map->Info());
    return num_relayed == before;
  }));
  ASSERT_OK(other.server.Call(&MapStub::CreateMap, CreateRequest("room")));  // as after a takeover
  room->AddMap("room", other.fleet.me());
  other.fleet.Forget("room");
  ASSERT_OK(owner.server.Stop());
  const auto info = map->Info();
  ASSERT_OK(info);
  EXPECT_EQ(info->num_frames, 0) << "of the other one's store";
}

TEST_F(FleetOfTwo, AClientUsesItsServerIfItCannotReachTheOwner) {
  FleetMember hidden{room};
  ASSERT_OK(hidden.server.Call(&MapStub::CreateMap, CreateRequest("cellar")));
  room->AddMap("cellar", hidden.fleet.me());
  (void)hidden.fleet.OwnerOf("cellar");
  (void)other.fleet.OwnerOf("cellar");
  // Answers now name another address than the one known to `other`.
  room->SetAddress(hidden.fleet.me(), "127.0.0.1:1");
  hidden.fleet.Forget("cellar");
  (void)hidden.fleet.OwnerOf("cellar");
  const client::Client connection = ConnectTo(other, true);
  const auto map = connection.OpenMap("cellar");
  ASSERT_OK(map);
  for (int i = 0; i < 5; ++i) EXPECT_OK(map->Info());
}

}  // namespace
}  // namespace dhpmap::testing
