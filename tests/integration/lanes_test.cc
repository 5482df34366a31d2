// SPDX-License-Identifier: BSD-3-Clause
// Calls of one kind do not wait for those of another, and what nobody waits for ends.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/integration/failing_store.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

constexpr int kManyPoints = 300'000;

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
    grpc::ClientContext create;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server_.maps->CreateMap(&create, CreateRequest("room"), &created).ok());
    ASSERT_TRUE(Feed(server_, "room", 0, 3).status.ok());
  }

  grpc::Status GetMap() {
    grpc::ClientContext context;
    v1::GetMapRequest request;
    request.set_name("maps/room");
    v1::GetMapResponse response;
    return server_.maps->GetMap(&context, request, &response);
  }

  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  static constexpr std::size_t kEnoughForAll_bytes = std::size_t{4} << 30;
  TestServer server_{
      *store_,
      {},
      {.num_threads = 2, .num_bulk_threads = 1, .inflight = std::make_shared<ByteBudget>(kEnoughForAll_bytes)}};
};

TEST_F(Lanes, AQuickCallIsAnsweredWhileBulkCallsWait) {
  constexpr int kNumBulk = 8;
  const v1::QueryPointsRequest request = ManyPoints("room");
  std::atomic<int> num_begun = 0, num_ended = 0;
  std::vector<std::thread> clients;
  clients.reserve(kNumBulk);
  for (int i = 0; i < kNumBulk; ++i) {
    clients.emplace_back([&] {
      grpc::ClientContext context;
      v1::QueryPointsResponse response;
      ++num_begun;
      EXPECT_TRUE(server_.queries->QueryPoints(&context, request, &response).ok());
      EXPECT_EQ(response.packed().observed_size(), kManyPoints);
      ++num_ended;
    });
  }
  EXPECT_TRUE(Eventually([&] { return num_begun == kNumBulk; }));
  EXPECT_TRUE(GetMap().ok());
  EXPECT_LT(num_ended, kNumBulk) << "it waited for all of them";
  for (std::thread& client : clients) client.join();
}

TEST_F(Lanes, CallsWhoseClientIsGoneLeaveTheQueueUnserved) {
  constexpr int kNumAbandoned = 40;
  const v1::QueryPointsRequest request = ManyPoints("room");
  const auto start = std::chrono::steady_clock::now();
  {
    grpc::ClientContext context;
    v1::QueryPointsResponse response;
    ASSERT_TRUE(server_.queries->QueryPoints(&context, request, &response).ok());
  }
  const auto one_call = std::chrono::steady_clock::now() - start;
  std::vector<std::thread> clients;
  clients.reserve(kNumAbandoned);
  for (int i = 0; i < kNumAbandoned; ++i) {
    clients.emplace_back([&] {
      grpc::ClientContext context;
      context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(1));
      v1::QueryPointsResponse response;
      EXPECT_FALSE(server_.queries->QueryPoints(&context, request, &response).ok());
    });
  }
  for (std::thread& client : clients) client.join();
  const auto then = std::chrono::steady_clock::now();
  grpc::ClientContext context;
  v1::QueryPointsResponse response;
  ASSERT_TRUE(server_.queries->QueryPoints(&context, request, &response).ok());
  // Served in turn, the abandoned ones would have taken forty times one call.
  EXPECT_LT(std::chrono::steady_clock::now() - then, 20 * one_call);
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
  static constexpr int kBoxes = 60'000;
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
  EXPECT_EQ(server_.queries->CheckCollisions(&context, HugeBoxes(60'000), &response).error_code(),
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
  EXPECT_TRUE(server_.Stop().ok()) << "nothing is left that would hold up the end";
}

TEST(LanesOfClosedMaps, CallsThatWaitForTheDiskDoNotHoldUpThoseOnOpenMaps) {
  FailingStore store;
  TestServer server(store, {}, {.num_threads = 2, .num_bulk_threads = 1});
  const auto create = [&](const std::string& map_id) {
    grpc::ClientContext context;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server.maps->CreateMap(&context, CreateRequest(map_id), &created).ok());
  };
  const auto list = [&](const std::string& map_id, std::chrono::seconds patience) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + patience);
    v1::ListSubmapsRequest request;
    request.set_parent("maps/" + map_id);
    v1::ListSubmapsResponse response;
    return server.submaps->ListSubmaps(&context, request, &response).ok();
  };
  constexpr int kNumClosed = 6;  // more than there are quick threads, and than are loaded at a time
  constexpr std::chrono::seconds kSoon{5}, kLate{60};
  create("open");
  for (int i = 0; i < kNumClosed; ++i) create("closed" + std::to_string(i));
  ASSERT_TRUE(list("open", kSoon));

  std::promise<void> disk;
  std::atomic<int> num_loading = 0;
  store.set_before_load([&num_loading, done = disk.get_future().share()] {
    ++num_loading;
    done.wait();
  });
  std::vector<std::future<bool>> waiting;
  waiting.reserve(kNumClosed);
  for (int i = 0; i < kNumClosed; ++i) {
    waiting.push_back(std::async(std::launch::async, [&, i] { return list("closed" + std::to_string(i), kLate); }));
  }
  EXPECT_TRUE(Eventually([&] { return num_loading >= 2; }));
  EXPECT_TRUE(list("open", kSoon)) << "it waited for the disk";
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kSoon);
  v1::GetMapRequest request;
  request.set_name("maps/closed0");
  v1::GetMapResponse response;
  EXPECT_TRUE(server.maps->GetMap(&context, request, &response).ok()) << "for which no map is loaded";
  disk.set_value();
  for (std::future<bool>& answer : waiting) EXPECT_TRUE(answer.get());
}

TEST(LanesOfClosedMaps, FramesThatWaitForTheDiskDoNotHoldUpThoseOfOpenMaps) {
  FailingStore store;
  TestServer server(store);
  constexpr int kNumClosed = 3;  // more than there are threads for frames
  const auto create = [&](const std::string& map_id) {
    grpc::ClientContext context;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server.maps->CreateMap(&context, CreateRequest(map_id), &created).ok());
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
