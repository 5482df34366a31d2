// SPDX-License-Identifier: BSD-3-Clause
// Calls of one kind do not wait for those of another, and what nobody waits for ends.
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

constexpr int kManyPoints = 3'000;  // more than are looked up at once: see EffortOf

v1::QueryPointsRequest ManyPoints(const std::string& map_id) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map_id);
  request.set_packed(true);
  for (int i = 0; i < 3 * kManyPoints; ++i) request.add_xyz_m(0.001f * static_cast<float>(i % 997));
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
  /// A call for the bulk lane.
  grpc::Status AskForMany(grpc::ClientContext& context) {
    v1::QueryPointsResponse response;
    const grpc::Status status = server_.queries->QueryPoints(&context, ManyPoints("room"), &response);
    if (status.ok()) {
      EXPECT_EQ(response.packed().observed_size(), kManyPoints);
    }
    return status;
  }
  /// So many such calls, the first of which keeps the lane's only thread until the gate is opened.
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
  std::size_t call_bytes_ = 0;  // that one call keeps
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

TEST_F(Lanes, CallsWhoseClientIsGoneLeaveTheQueueUnserved) {
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

/// Boxes of 10 m, padded by as much: each is near all of the map.
v1::CheckCollisionsRequest HugeBoxes(int num_boxes) {
  v1::CheckCollisionsRequest request;
  request.set_map("maps/room");
  request.set_packed(true);
  request.mutable_options()->set_unknown_policy(v1::QueryOptions::FREE);
  request.mutable_options()->mutable_padding()->set_default_m(10);
  for (int i = 0; i < num_boxes; ++i) {
    v1::OrientedBox& box = *request.add_bodies()->mutable_box();
    box.mutable_pose()->mutable_rotation()->set_w(1);
    box.mutable_size_m()->set_x(10);
    box.mutable_size_m()->set_y(10);
    box.mutable_size_m()->set_z(10);
  }
  return request;
}

/// So many calls that check more than anybody waits for.
class LongChecks {
 public:
  LongChecks(TestServer& server, int num_calls) : contexts_(static_cast<std::size_t>(num_calls)) {
    const auto request = std::make_shared<const v1::CheckCollisionsRequest>(HugeBoxes(kBoxes));
    for (auto& context : contexts_) {
      context = std::make_unique<grpc::ClientContext>();
      calls_.emplace_back([&server, &context = *context, request, this] {
        v1::CheckCollisionsResponse response;
        const grpc::Status status = server.queries->CheckCollisions(&context, *request, &response);
        EXPECT_EQ(status.error_code(), grpc::StatusCode::CANCELLED) << status.error_message();
        ++num_ended_;
      });
    }
  }
  ~LongChecks() { Cancel(); }
  LongChecks(const LongChecks&) = delete;
  LongChecks& operator=(const LongChecks&) = delete;

  void Cancel() {
    for (const auto& context : contexts_) context->TryCancel();
    for (std::thread& call : calls_) call.join();
    calls_.clear();
  }
  [[nodiscard]] int num_ended() const { return num_ended_; }

 private:
  static constexpr int kBoxes = 200'000;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts_;
  std::vector<std::thread> calls_;
  std::atomic<int> num_ended_ = 0;
};

TEST_F(Lanes, ChecksThatTakeLongHoldUpNeitherMeshesNorOtherChecks) {
  constexpr int kLong = 6;  // more than there are threads for them
  LongChecks checks(server_, kLong);
  EXPECT_TRUE(Eventually([&] { return server_.grpc().num_running_checks() == kLong; }));
  grpc::ClientContext mesh_context;
  v1::GetSubmapMeshRequest mesh_request;
  mesh_request.set_name("maps/room");
  auto mesh = server_.submaps->GetSubmapMesh(&mesh_context, mesh_request);
  v1::GetSubmapMeshResponse part;
  while (mesh->Read(&part)) {
  }
  EXPECT_TRUE(mesh->Finish().ok());
  v1::CheckCollisionsRequest small = HugeBoxes(300);  // too many to be quick
  small.mutable_options()->clear_padding();
  for (v1::Body& body : *small.mutable_bodies()) body.mutable_box()->mutable_size_m()->Clear();
  grpc::ClientContext context;
  v1::CheckCollisionsResponse response;
  EXPECT_TRUE(server_.queries->CheckCollisions(&context, small, &response).ok());
  EXPECT_EQ(response.packed().colliding_size(), 300);
  EXPECT_EQ(checks.num_ended(), 0) << "they waited for some of them";
}

TEST_F(Lanes, ChecksEndAtTheirDeadlineAndWithTheirClient) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(300));
  v1::CheckCollisionsResponse response;
  EXPECT_EQ(server_.queries->CheckCollisions(&context, HugeBoxes(200'000), &response).error_code(),
            grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_TRUE(Eventually([&] { return server_.grpc().num_running_checks() == 0; }));
  LongChecks checks(server_, 3);
  EXPECT_TRUE(Eventually([&] { return server_.grpc().num_running_checks() == 3; }));
  checks.Cancel();
  EXPECT_TRUE(Eventually([&] { return server_.grpc().num_running_checks() == 0; }));
  EXPECT_TRUE(server_.Stop().ok()) << "nothing is left that would hold up the end";
}

TEST_F(Lanes, FewHugeBodiesAreAnsweredAsManySmallOnesAre) {
  v1::CheckCollisionsRequest request = HugeBoxes(200);  // so few are begun as a quick call is
  v1::CheckCollisionsResponse together, alone;
  {
    grpc::ClientContext context;
    ASSERT_TRUE(server_.queries->CheckCollisions(&context, request, &together).ok());
  }
  request.mutable_bodies()->DeleteSubrange(1, 199);
  grpc::ClientContext context;
  ASSERT_TRUE(server_.queries->CheckCollisions(&context, request, &alone).ok());
  ASSERT_EQ(together.packed().colliding_size(), 200);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(together.packed().depth_m(i), alone.packed().depth_m(0)) << i;
  EXPECT_TRUE(alone.packed().colliding(0));
}

TEST_F(Lanes, AMeshThatNobodyTakesAnyMoreEnds) {
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

TEST(LanesOfClosedMaps, CallsThatWaitForTheDiskDoNotHoldUpThoseOnOpenMaps) {
  FailingStore store;
  TestServer server(store, {}, {.num_threads = 2, .num_bulk_threads = 1});
  const auto create = [&](const std::string& map_id) {
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest(map_id)));
  };
  const auto list = [&](const std::string& map_id) {
    return server.Call(&SubmapStub::ListSubmaps, "maps/" + map_id).ok();
  };
  constexpr int kNumClosed = 6;  // more than there are quick threads, and than are loaded at a time
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

TEST(LanesOfClosedMaps, FramesThatWaitForTheDiskDoNotHoldUpThoseOfOpenMaps) {
  FailingStore store;
  TestServer server(store);
  constexpr int kNumClosed = 3;  // more than there are threads for frames
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
    EXPECT_EQ(fused->outcome(), v1::FUSED);
  }
}

}  // namespace
}  // namespace dhpmap::testing
