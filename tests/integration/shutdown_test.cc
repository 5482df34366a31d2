// SPDX-License-Identifier: BSD-3-Clause
// A server that shuts down ends after its grace period, whatever it is fusing.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "mapping/pipeline/map_builder.h"
#include "server/app/feeds/frame_recorder.h"
#include "server/wire/frame_conversion.h"
#include "tests/integration/feeder.h"
#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"

namespace dhpmap::testing {
namespace {

/// Observes when the writer takes a frame and when it refuses it.
class FrameWitness final : public FrameRecorder {
 public:
  using Taken = std::function<void(std::int64_t sequence)>;
  using Refused = std::function<void(const Status& why)>;
  FrameWitness(Taken taken, Refused refused) : taken_(std::move(taken)), refused_(std::move(refused)) {}

  void OnFrame(const std::string&, std::int64_t sequence, ArrivedMessage, std::int64_t) override { taken_(sequence); }
  void OnRefused(const Status& why) override { refused_(why); }
  void OnRefined() override {}
  void OnEdited(std::int64_t, const ArrivedEdit&) override {}
  void OnFinished() override {}

 private:
  const Taken taken_;
  const Refused refused_;
};

TEST(Shutdown, CancelsTheRunningFrameAfterTheGracePeriod) {
  constexpr int kFrames = 4, kInHand = 1;
  std::promise<void> in_hand;
  std::atomic<const OpenMap*> room = nullptr;
  std::atomic<int> num_refused = 0;
  const auto hold = [&](std::int64_t sequence) {
    if (sequence != kInHand) return;
    in_hand.set_value();
    EXPECT_TRUE(Eventually([&] { return room.load()->HasGivenUpMapping(); }));
  };
  const auto count = [&](const Status& why) {
    EXPECT_EQ(why.code(), StatusCode::kUnavailable);
    ++num_refused;
  };
  const auto store = MakeMemoryStore();
  TestServer server(*store,
                    {.make_recorder = [&](const MapInfo&) { return std::make_unique<FrameWitness>(hold, count); }});
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  const std::shared_ptr<OpenMap> session = *server.registry().GetOpen("room");
  room = session.get();
  const MapInfo info = session->View()->snapshot().info();

  Feeder feeder(server, "room");
  for (int i = 0; i < kFrames; ++i) ASSERT_TRUE(feeder.Send(i, i));
  in_hand.get_future().wait();
  server.grpc().Shutdown(/*grace_s=*/0.01);
  EXPECT_FALSE(feeder.Finish().ok());
  ASSERT_OK(server.registry().Shutdown());
  EXPECT_EQ(num_refused, 1) << "of those that were taken";

  // Only complete frames are stored.
  const auto stored = store->LoadMap("room");
  ASSERT_OK(stored);
  EXPECT_EQ((*stored)->info().num_frames, kInHand);
  MapBuilder alone(info, 1);
  const auto frame = FrameFromProto(TestFrame(0));
  ASSERT_OK(frame);
  ASSERT_OK(alone.Integrate(*frame));
  EXPECT_TRUE(MapsAreEqual(*alone.map().Freeze(), **stored));
}

TEST(ShutdownAtOnce, LeavesNoTaskThatUsesTheRegistry) {
  for (int i = 0; i < 40; ++i) {
    const std::unique_ptr<MapStore> store = MakeMemoryStore();
    TestServer server(*store);
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    server.grpc().Shutdown(1e-4 * i);  // ends at about the same time as the other work
  }
}

}  // namespace
}  // namespace dhpmap::testing
