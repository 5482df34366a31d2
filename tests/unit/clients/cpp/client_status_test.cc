// SPDX-License-Identifier: BSD-3-Clause
// How a server is, as the C++ client tells it.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "tests/integration/feeder.h"
#include "tests/support/assert_ok.h"
#include "tests/unit/clients/cpp/client_room.h"

namespace dhpmap::testing {
namespace {

TEST(ClientStatus, IsThatOfTheServerAndOfItsFeeds) {
  const TempDir folder;
  const auto store = MakeMemoryStore();
  TestServer server(*store, {}, {.version = "1.2.3", .database = folder.path().string(), .max_behind_s = 12});
  server.grpc().SetServing(true);
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  Feeder feeder(server, "room", {.session = "robot"});
  ASSERT_TRUE(feeder.Feed(0));

  const auto status = ConnectTo(AddressOf(server)).GetStatus();
  ASSERT_OK(status);
  EXPECT_EQ(status->version, "1.2.3");
  EXPECT_TRUE(status->is_ready);
  EXPECT_GE(status->time, status->start_time);
  EXPECT_GT(status->time.time_since_epoch(), std::chrono::hours(24 * 365 * 50)) << "it is of this century";
  EXPECT_GT(status->disk_free_bytes, 0);
  EXPECT_EQ(status->max_behind_s, 12);
  ASSERT_EQ(status->feeds.size(), 1u);
  EXPECT_EQ(status->feeds[0].map, "room");
  EXPECT_EQ(status->feeds[0].session, "robot");
  EXPECT_EQ(status->feeds[0].num_frames, 1);
  feeder.HalfClose();
  EXPECT_OK(feeder.Finish());
}

}  // namespace
}  // namespace dhpmap::testing
