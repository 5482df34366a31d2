// SPDX-License-Identifier: BSD-3-Clause
// Calls of one kind do not wait for those of another, and calls of disconnected clients end.
#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <future>
#include <latch>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/integration/failing_store.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

constexpr int kManyPoints = 3'000;  // too many for a quick call: see EffortOf

v1::QueryPointsRequest ManyPoints(const std::string& map_id) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map_id);
  request.set_packed(true);
  for (int i = 0; i < 3 * kManyPoints; ++i) request.add_packed_points_m(0.001f * static_cast<float>(i % 997));
  return request;
}

class Lanes : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(server_.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server_, "room", 0, 3));
  }

  void TearDown() override { OpenGate(); }

  grpc::Status GetMap() { return server_.Call(&MapStub::GetMap, "maps/room").status(); }
  /// Makes a call for the bulk lane.
  grpc::Status AskForMany(grpc::ClientContext& context) {
    v1::QueryPointsResponse response;
    const grpc::Status status = server_.queries->QueryPoints(&context, ManyPoints("room"), &response);
    if (status.ok()) {
      EXPECT_EQ(response.packed().near_surface_size(), kManyPoints);
    }
    return status;
  }
  /// Makes so many bulk calls. The first occupies the lane's only thread until the gate opens.
  void FillBulkLane(int num_calls) {
    for (int i = 0; i < num_calls; ++i) {
      grpc::ClientContext& context = contexts_.emplace_back();
      calls_.push_back(std::async(std::launch::async, [&] { return AskForMany(context); }));
      if (i == 0) {
        ASSERT_TRUE(Eventually([&] { return num_served_ == 1; })) << "it is under way";
        call_bytes_ = inflight_->used_bytes();
      }
      ASSERT_TRUE(Eventually([&] { return inflight_->used_bytes() == calls_.size() * call_bytes_; })) << "it has come";
    }
  }
  void OpenGate() {
    if (!gate_.try_wait()) gate_.count_down();
  }

  static constexpr std::size_t kEnoughForAll_bytes = 512u << 20;
  const std::shared_ptr<ByteBudget> inflight_ = std::make_shared<ByteBudget>(kEnoughForAll_bytes);
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  std::latch gate_{1};
  std::atomic<int> num_served_ = 0, num_cancelled_ = 0;
  TestServer server_{*store_,
                     {},
                     {.num_threads = 2, .num_bulk_threads = 1, .inflight = inflight_},
                     {.on_call = [this](std::string_view, StatusCode code,
                                        double) { num_cancelled_ += code == StatusCode::kCancelled ? 1 : 0; },
                      .on_query =
                          [this](std::size_t) {
                            ++num_served_;
                            gate_.wait();
                          }}};
  std::size_t call_bytes_ = 0;  // memory of one call
  std::deque<grpc::ClientContext> contexts_;
  std::vector<std::future<grpc::Status>> calls_;
};

TEST_F(Lanes, AQuickCallIsAnsweredWhileBulkCallsWait) {
  FillBulkLane(8);
  EXPECT_OK(GetMap());
  EXPECT_EQ(num_served_, 1) << "the others wait for the first";
  OpenGate();
  for (auto& call : calls_) EXPECT_OK(call.get());
  EXPECT_EQ(num_served_, 8);
}

TEST_F(Lanes, CallsOfDisconnectedClientsLeaveTheQueueUnserved) {
  constexpr int kNumAbandoned = 40;
  FillBulkLane(1 + kNumAbandoned);
  for (std::size_t i = 1; i < contexts_.size(); ++i) contexts_[i].TryCancel();
  for (std::size_t i = 1; i < calls_.size(); ++i) EXPECT_EQ(calls_[i].get().error_code(), grpc::CANCELLED);
  EXPECT_TRUE(Eventually([&] { return num_cancelled_ == kNumAbandoned; })) << "though the lane's thread is busy";
  OpenGate();
  EXPECT_OK(calls_[0].get());
  grpc::ClientContext context;
  EXPECT_OK(AskForMany(context));
  EXPECT_EQ(num_served_, 2);
}

TEST_F(Lanes, AMeshOfADisconnectedClientEnds) {
  grpc::ClientContext context;
  v1::GetSubmapMeshRequest request;
  request.set_name("maps/room");
  auto mesh = server_.submaps->GetSubmapMesh(&context, request);
  v1::GetSubmapMeshResponse part;
  ASSERT_TRUE(mesh->Read(&part));
  EXPECT_GT(part.total_bytes(), 0);
  context.TryCancel();
  while (mesh->Read(&part)) {
  }
  EXPECT_EQ(mesh->Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_OK(server_.Stop()) << "nothing is left that would hold up the end";
}

TEST(LanesOfClosedMaps, CallsThatWaitForTheDiskDoNotDelayCallsOnOpenMaps) {
  FailingStore store;
  TestServer server(store, {}, {.num_threads = 2, .num_bulk_threads = 1});
  const auto create = [&](const std::string& map_id) {
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest(map_id)));
  };
  const auto list = [&](const std::string& map_id) {
    return server.Call(&SubmapStub::ListSubmaps, "maps/" + map_id).ok();
  };
  constexpr int kNumClosed = 6;  // more than the quick threads and the concurrent loads
  create("open");
  for (int i = 0; i < kNumClosed; ++i) create("closed" + std::to_string(i));
  ASSERT_TRUE(list("open"));

  std::promise<void> disk;
  std::atomic<int> num_loading = 0;
  store.set_before_load([&num_loading, done = disk.get_future().share()] {
    ++num_loading;
    done.wait();
  });
  std::vector<std::future<bool>> waiting;
  waiting.reserve(kNumClosed);
  for (int i = 0; i < kNumClosed; ++i) {
    waiting.push_back(std::async(std::launch::async, [&, i] { return list("closed" + std::to_string(i)); }));
  }
  EXPECT_TRUE(Eventually([&] { return num_loading >= 2; }));
  EXPECT_TRUE(list("open")) << "it waited for the disk";
  EXPECT_OK(server.Call(&MapStub::GetMap, "maps/closed0")) << "for which no map is loaded";
  disk.set_value();
  for (std::future<bool>& answer : waiting) EXPECT_TRUE(answer.get());
}

TEST(LanesOfClosedMaps, FramesThatWaitForTheDiskDoNotDelayFramesOfOpenMaps) {
  FailingStore store;
  TestServer server(store);
  constexpr int kNumClosed = 3;  // more than the threads for frames
  const auto create = [&](const std::string& map_id) {
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest(map_id)));
  };
  create("open");
  for (int i = 0; i < kNumClosed; ++i) create("closed" + std::to_string(i));
  Feeder robot(server, "open");
  ASSERT_TRUE(robot.Feed(0));

  std::promise<void> disk;
  std::atomic<int> num_loading = 0;
  store.set_before_load([&num_loading, done = disk.get_future().share()] {
    ++num_loading;
    done.wait();
  });
  std::vector<std::unique_ptr<Feeder>> waiting;
  for (int i = 0; i < kNumClosed; ++i) {
    waiting.push_back(std::make_unique<Feeder>(server, "closed" + std::to_string(i)));
    EXPECT_TRUE(waiting.back()->Send(0, 0));
  }
  EXPECT_TRUE(Eventually([&] { return num_loading == kNumClosed; }));
  auto fed = std::async(std::launch::async, [&] { return robot.Feed(1).has_value(); });
  EXPECT_EQ(fed.wait_for(kPatience), std::future_status::ready) << "it waited for the disk";
  disk.set_value();
  EXPECT_TRUE(fed.get());
  for (const auto& feeder : waiting) {
    const auto fused = feeder->Read();
    ASSERT_TRUE(fused);
    EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED);
  }
}

}  // namespace
}  // namespace dhpmap::testing
