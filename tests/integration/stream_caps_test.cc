// SPDX-License-Identifier: BSD-3-Clause
// Limits of streams: one beyond a limit is refused at once or waits in its client, and earlier ones continue.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/integration/feeder.h"
#include "tests/integration/watcher.h"

namespace dhpmap::testing {
namespace {

class StreamCaps : public ::testing::Test {
 protected:
  void Begin(const OpenMapOptions& options) {
    server = std::make_unique<TestServer>(*store, options);
    ASSERT_OK(server->Call(&MapStub::CreateMap, CreateRequest("room")));
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  std::unique_ptr<TestServer> server;
};

TEST_F(StreamCaps, AFeederBeyondThemIsRefusedAtOnceAndOthersContinue) {
  Begin({.feeds = {.idle_s = 1000, .max_feeds = 2}});
  Feeder a(*server, "room", {.session = "a"}), b(*server, "room", {.session = "b"});
  ASSERT_TRUE(a.Feed(0) && b.Feed(0));
  {
    Feeder beyond(*server, "room", {.session = "c"});
    EXPECT_FALSE(beyond.Feed(0)) << "its frame is not taken";
    const grpc::Status refused = beyond.Finish();
    EXPECT_EQ(refused.error_code(), grpc::RESOURCE_EXHAUSTED) << refused.error_message();
    EXPECT_EQ(ReasonOf(refused), "TOO_MANY_FEEDS");
  }
  for (Feeder* feeder : {&a, &b}) {
    const auto fused = feeder->Feed(1);
    ASSERT_TRUE(fused) << "it was there before";
    EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED);
  }
  a.HalfClose();
  ASSERT_OK(a.Finish());
  Feeder next(*server, "room", {.session = "c"});
  const auto fused = next.Feed(0);
  ASSERT_TRUE(fused) << "one that goes makes room";
  EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED);
}

TEST_F(StreamCaps, OfOneConnectionDelayNoOtherAndItsNextCallWaitsInTheClient) {
  constexpr std::size_t kMostOfOneConnection = 128;
  Begin({});
  v1::WatchMapRequest request;
  request.set_map("maps/room");
  request.set_progress_interval_s(300);
  std::vector<std::unique_ptr<Watcher>> watchers;
  watchers.reserve(kMostOfOneConnection);
  v1::WatchMapResponse message;
  while (watchers.size() < kMostOfOneConnection) {
    watchers.push_back(std::make_unique<Watcher>(*server->watches, request));
    ASSERT_TRUE(watchers.back()->Read(message)) << "stream " << watchers.size();
  }
  const auto list_maps = [](v1::MapService::Stub& maps, std::chrono::milliseconds timeout) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + timeout);
    v1::ListMapsResponse response;
    return maps.ListMaps(&context, {}, &response).error_code();
  };
  EXPECT_EQ(list_maps(*server->maps, std::chrono::milliseconds(300)), grpc::DEADLINE_EXCEEDED);
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection of its own
  const auto other = v1::MapService::NewStub(grpc::CreateCustomChannel(
      "127.0.0.1:" + std::to_string(server->grpc().port()), grpc::InsecureChannelCredentials(), arguments));
  EXPECT_EQ(list_maps(*other, kPatience), grpc::OK);

  watchers.pop_back();
  EXPECT_EQ(list_maps(*server->maps, kPatience), grpc::OK);
  v1::UpdateMapRequest rename;
  rename.mutable_map()->set_name("maps/room");
  rename.mutable_map()->set_display_name("Kitchen");
  ASSERT_OK(server->Call(&MapStub::UpdateMap, rename));
  for (const auto& watcher : watchers) {
    do {
      ASSERT_TRUE(watcher->Read(message));
    } while (!message.has_change());
    EXPECT_EQ(message.change().display_name(), "Kitchen");
  }
}

}  // namespace
}  // namespace dhpmap::testing
