// SPDX-License-Identifier: BSD-3-Clause
// GetServerStatus, and the pulse of the lane that answers queries.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <utility>

#include "dhpmap/v1/server_service.grpc.pb.h"
#include "server/service/lane_pulse.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

using ServerStub = v1::ServerService::Stub;

TEST(ServerStatus, DescribesTheServerItsDiskAndItsFeeds) {
  const TempDir folder;
  const std::string file = (folder.path() / "maps.db").string();
  std::ofstream(file) << "1234567";
  const auto store = MakeMemoryStore();
  TestServer server(*store, {}, {.version = "1.2.3", .database = file, .max_behind_s = 12});
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));

  Feeder feeder(server, "room", {.session = "robot"});
  ASSERT_TRUE(feeder.Feed(0));

  server.grpc().SetServing(true);
  const auto status = server.Call(&ServerStub::GetServerStatus, v1::GetServerStatusRequest());
  ASSERT_OK(status);
  EXPECT_EQ(status->version(), "1.2.3");
  EXPECT_TRUE(status->ready());
  EXPECT_EQ(status->database_bytes(), 7);
  EXPECT_GT(status->disk_free_bytes(), 0);
  EXPECT_GE(status->disk_total_bytes(), status->disk_free_bytes());
  EXPECT_EQ(status->max_behind_s(), 12);
  EXPECT_GE(status->current_time().seconds(), status->start_time().seconds());
  ASSERT_EQ(status->feeds_size(), 1);
  EXPECT_EQ(status->feeds(0).name(), "maps/room/sessions/robot");
  EXPECT_EQ(status->feeds(0).num_frames(), 1);
  EXPECT_GE(status->feeds(0).silent_s(), 0);

  server.grpc().SetServing(false);
  const auto draining = server.Call(&ServerStub::GetServerStatus, v1::GetServerStatusRequest());
  ASSERT_OK(draining);
  EXPECT_FALSE(draining->ready());
  feeder.HalfClose();
  EXPECT_OK(feeder.Finish());
}

TEST(ServerStatus, ContainsTheLastWarningOfAFeed) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  const auto feed_of = [&server](const std::string& session) {
    const auto status = server.Call(&ServerStub::GetServerStatus, v1::GetServerStatusRequest());
    if (status.ok()) {
      for (const v1::ActiveFeed& feed : status->feeds()) {
        if (feed.name() == "maps/room/sessions/" + session) return feed;
      }
    }
    return v1::ActiveFeed();
  };
  const auto fed = [](Feeder& feeder, int sequence, int frame) {
    return feeder.Send(sequence, frame) && feeder.Read().has_value();
  };
  for (const bool are_refused : {false, true}) {
    const std::string session = are_refused ? "strict" : "lenient";
    Feeder feeder(server, "room", {.session = session, .refuse_implausible = are_refused});
    ASSERT_TRUE(fed(feeder, 1, 0));
    EXPECT_EQ(feed_of(session).num_implausible(), 0);
    EXPECT_FALSE(feed_of(session).has_last_warning());
    ASSERT_TRUE(fed(feeder, 2, 0));
    ASSERT_TRUE(fed(feeder, 3, 1));
    const v1::ActiveFeed feed = feed_of(session);
    EXPECT_EQ(feed.num_refused(), are_refused ? 1 : 0);
    EXPECT_EQ(feed.num_implausible(), 1);
    EXPECT_EQ(feed.last_warning().fault(), v1::FrameWarning::STAMP_REPEATED);
    EXPECT_EQ(feed.num_plausible_since(), 1);
    feeder.HalfClose();
    EXPECT_OK(feeder.Finish());
  }
}

TEST(ServerStatus, MarksAnUnknownDiskAsUnknown) {
  const auto store = MakeMemoryStore();
  TestServer server(*store, {}, {.database = "/no/such/folder/maps.db"});
  const auto status = server.Call(&ServerStub::GetServerStatus, v1::GetServerStatusRequest());
  ASSERT_OK(status);
  EXPECT_EQ(status->disk_free_bytes(), -1);
  EXPECT_EQ(status->disk_total_bytes(), -1);
  EXPECT_EQ(status->database_bytes(), 0);
}

/// The lane has one thread, so its pulse needs a free lane.
TEST(QuickLanePulse, StopsWhileTheLaneIsBlocked) {
  const auto store = MakeMemoryStore();
  std::promise<void> release;
  std::atomic<int> num_felt = 0;
  {
    TestServer server(*store, {}, {.num_threads = 1});
    service::LanePulse pulse([&](std::function<void()> work) { return server.grpc().PostQuick(std::move(work)); },
                             [&] { ++num_felt; });
    std::promise<void> stuck;
    ASSERT_TRUE(server.grpc().PostQuick([&] {
      stuck.set_value();
      release.get_future().wait();
    }));
    stuck.get_future().wait();
    pulse.Beat();
    EXPECT_EQ(num_felt, 0);
    release.set_value();
    ASSERT_TRUE(Eventually([&] { return num_felt == 1; }));
    pulse.Beat();
    ASSERT_TRUE(Eventually([&] { return num_felt == 2; })) << "it recovers";
  }
}

}  // namespace
}  // namespace dhpmap::testing
