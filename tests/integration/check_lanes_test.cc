// SPDX-License-Identifier: BSD-3-Clause
// Long checks run in pieces on their own lane. They delay no other calls, and end when their client disconnects.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

class CheckLanes : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(server_.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server_, "room", 0, 3));
  }

  static constexpr std::size_t kEnoughForAll_bytes = std::size_t{4} << 30;
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_{
      *store_,
      {},
      {.num_threads = 2, .num_bulk_threads = 1, .inflight = std::make_shared<ByteBudget>(kEnoughForAll_bytes)}};
};

/// Boxes of 10 m with a padding of 10 m: each is near the whole map.
v1::CheckCollisionsRequest HugeBoxes(int num_boxes) {
  v1::CheckCollisionsRequest request;
  request.set_map("maps/room");
  request.set_packed(true);
  request.mutable_options()->set_unknown_policy(v1::QueryOptions::FREE);
  request.mutable_options()->mutable_padding()->set_default_padding_m(10);
  for (int i = 0; i < num_boxes; ++i) {
    v1::OrientedBox& box = *request.add_bodies()->mutable_box();
    box.mutable_pose()->mutable_rotation()->set_w(1);
    box.mutable_size_m()->set_x(10);
    box.mutable_size_m()->set_y(10);
    box.mutable_size_m()->set_z(10);
  }
  return request;
}

/// A number of calls whose checks take longer than the test.
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

TEST_F(CheckLanes, LongChecksDelayNeitherMeshesNorOtherChecks) {
  constexpr int kLong = 6;  // more than there are threads for checks
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
  v1::CheckCollisionsRequest small = HugeBoxes(300);  // too many for a quick call
  small.mutable_options()->clear_padding();
  for (v1::Body& body : *small.mutable_bodies()) body.mutable_box()->mutable_size_m()->Clear();
  grpc::ClientContext context;
  v1::CheckCollisionsResponse response;
  EXPECT_TRUE(server_.queries->CheckCollisions(&context, small, &response).ok());
  EXPECT_EQ(response.packed().colliding_size(), 300);
  EXPECT_EQ(checks.num_ended(), 0) << "they waited for some of them";
}

TEST_F(CheckLanes, ChecksEndAtTheirDeadlineOrWhenTheirClientDisconnects) {
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

TEST_F(CheckLanes, ManyHugeBodiesAreAnsweredLikeOneAlone) {
  v1::CheckCollisionsRequest request = HugeBoxes(200);  // few enough to begin as a quick call
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

}  // namespace
}  // namespace dhpmap::testing
