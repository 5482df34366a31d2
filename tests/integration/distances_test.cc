// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <thread>

#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

/// A mapped TestScene, and distances in it through both channels.
class DistancesTest : public ::testing::Test {
 protected:
  DistancesTest() {
    EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(Feed(server, "room", 0, 40));
    EXPECT_OK(server.Call(&MappingStub::FinishMapping, "maps/room"));
    request.set_map("maps/room");
  }
  void AddPoint(double x, double y, double z) {
    for (const double value : {x, y, z}) request.add_packed_points_m(static_cast<float>(value));
  }
  v1::QueryDistancesResponse Ask() { return Ask(server.channel()); }
  v1::QueryDistancesResponse Ask(const std::shared_ptr<grpc::Channel>& channel) {
    return Client(channel).Call(&QueryStub::QueryDistances, request).KeepStatus(status);
  }
  std::int64_t Last() { return server.Call(&MapStub::GetMap, "maps/room").value().map().revision(); }

  const std::shared_ptr<ByteBudget> inflight = std::make_shared<ByteBudget>(256u << 20);
  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store, {}, {.inflight = inflight}};
  v1::QueryDistancesRequest request;
  grpc::Status status;
};

TEST_F(DistancesTest, AreThoseOfTheSceneAndNameTheirObject) {
  AddPoint(0, 0, 1.3);
  AddPoint(0, 0, 0.79);
  AddPoint(50, 0, 0);
  const v1::QueryDistancesResponse response = Ask();
  ASSERT_OK(status);
  ASSERT_EQ(response.results_size(), 3);
  const Scene scene = TestScene();
  EXPECT_NEAR(response.results(0).distance_m(), scene.Distance({0, 0, 1.3}), 0.03);
  EXPECT_GT(response.results(0).gradient().z(), 0.95);
  EXPECT_NEAR(response.results(1).distance_m(), scene.Distance({0, 0, 0.79}), 0.03);
  EXPECT_GT(response.results(0).instance_id(), 0);
  EXPECT_EQ(response.results(0).instance_id(), response.results(1).instance_id());
  EXPECT_EQ(response.results(1).status(), v1::QueryStatus::OK);
  EXPECT_EQ(response.results(2).status(), v1::QueryStatus::CLAMPED);
  EXPECT_GT(response.revision(), 0);
  EXPECT_EQ(Ask(server.grpc().InProcessChannel()).SerializeAsString(), response.SerializeAsString())
      << "the door that REST goes through";
}

TEST_F(DistancesTest, PackedAnswersAreTheSameInArraysAlsoInTheBulkLane) {
  for (int i = 0; i < 3000; ++i) AddPoint(0.001 * i - 1.5, 0.3, 0.4);
  const v1::QueryDistancesResponse messages = Ask();
  request.set_packed(true);
  const v1::QueryDistancesResponse arrays = Ask();
  ASSERT_OK(status);
  ASSERT_EQ(messages.results_size(), 3000);
  ASSERT_EQ(arrays.packed().distance_m_size(), 3000);
  for (int i = 0; i < 3000; ++i) {
    EXPECT_EQ(arrays.packed().distance_m(i), messages.results(i).distance_m());
    EXPECT_EQ(arrays.packed().instance_id(i), messages.results(i).instance_id());
    EXPECT_EQ(arrays.packed().status(i), messages.results(i).status());
  }
}

TEST_F(DistancesTest, WithAToleranceTheyExceedTheTruthByThatAtMostAndAreNeverShorter) {
  for (int i = 0; i < 4000; ++i) {
    const int column = i % 16, row = i / 16 % 16, layer = i / 256;
    AddPoint(0.02 * column, 0.02 * row, 0.7 + 0.04 * layer);
  }
  request.set_packed(true);
  const v1::QueryDistancesResponse exact = Ask();
  request.mutable_options()->set_tolerance_vox(0.4);
  ASSERT_OK_AND_ASSIGN(const auto got, server.Call(&MapStub::GetMap, "maps/room"));
  const double tolerance_m = 0.4 * got.map().config().voxel_size_m();
  for (const char* round : {"first", "with what the first left"}) {
    const v1::QueryDistancesResponse answers = Ask();
    ASSERT_OK(status);
    for (int i = 0; i < 4000; ++i) {
      const float wanted_m = exact.packed().distance_m(i), distance_m = answers.packed().distance_m(i);
      EXPECT_GT(std::abs(distance_m), std::abs(wanted_m) - 1e-4) << round << i;
      EXPECT_LT(std::abs(distance_m), 1.08 * std::abs(wanted_m) + tolerance_m + 1e-4) << round << i;
      EXPECT_EQ(answers.packed().status(i), exact.packed().status(i)) << round << i;
    }
  }
  request.mutable_options()->set_tolerance_vox(-1);
  (void)Ask();
  EXPECT_EQ(BadFieldOf(status), "options.tolerance_vox");
}

TEST_F(DistancesTest, FollowAnObjectThatIsMovedOrExcluded) {
  AddPoint(0, 0, 0.9);
  const v1::DistanceResult before = Ask().results(0);
  v1::UpdateSubmapRequest move;
  move.mutable_submap()->set_name(before.submap());
  move.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_z(0.1);
  move.mutable_update_mask()->add_paths("map_from_submap");
  ASSERT_OK_AND_ASSIGN(const auto moved, server.Call(&SubmapStub::UpdateSubmap, move));
  const v1::QueryDistancesResponse after = Ask();
  EXPECT_EQ(after.revision(), moved.revision());
  EXPECT_EQ(after.results(0).instance_id(), before.instance_id());
  EXPECT_NEAR(after.results(0).distance_m(), before.distance_m() - 0.1, 0.01);
  request.mutable_options()->add_excluded_submaps(before.submap());
  EXPECT_NE(Ask().results(0).instance_id(), before.instance_id());
}

TEST_F(DistancesTest, TheInsideOfADeletedObjectIsUnknownUnlessVacatedSpaceCountsAsFree) {
  AddPoint(0, 0, 0.4);  // the centre of the ball
  const v1::DistanceResult before = Ask().results(0);
  EXPECT_EQ(before.status(), v1::QueryStatus::UNKNOWN);
  ASSERT_OK(server.Call(&SubmapStub::DeleteSubmap, before.submap()));
  EXPECT_EQ(Ask().results(0).status(), v1::QueryStatus::UNKNOWN);
  request.mutable_options()->set_vacated_policy(v1::Vacated::FREE);
  const v1::DistanceResult after = Ask().results(0);
  EXPECT_EQ(after.status(), v1::QueryStatus::OK);
  EXPECT_GT(after.distance_m(), 0.2);
  EXPECT_NE(after.submap(), before.submap());
  request.mutable_options()->set_vacated_policy(v1::Vacated::UNKNOWN);
  EXPECT_EQ(Ask().results(0).status(), v1::QueryStatus::UNKNOWN);
}

TEST_F(DistancesTest, RaysMeetTheSceneThroughBothDoors) {
  v1::CastRaysRequest rays;
  rays.set_map("maps/room");
  for (const float value : {0.f, 0.f, 2.f}) rays.add_packed_origins_m(value);
  for (const float value : {0.f, 0.f, -1.f, 0.f, 0.f, 1.f}) rays.add_packed_directions(value);
  std::string first;
  for (const auto& channel : {server.channel(), server.grpc().InProcessChannel()}) {
    ASSERT_OK_AND_ASSIGN(const auto response, Client(channel).Call(&QueryStub::CastRays, rays));
    ASSERT_EQ(response.results_size(), 2);
    EXPECT_NEAR(response.results(0).distance_m(), TestScene().Distance({0, 0, 2}), 0.03) << "the ball, from above";
    EXPECT_GT(response.results(0).instance_id(), 0);
    EXPECT_EQ(response.results(1).instance_id(), -1);
    EXPECT_EQ(response.results(1).distance_m(), 3);
    if (first.empty()) first = response.SerializeAsString();
    EXPECT_EQ(response.SerializeAsString(), first);
  }
}

TEST_F(DistancesTest, WaitForARevisionUntilTheDeadline) {
  AddPoint(0, 0, 1);
  const std::int64_t now = Ask().revision();
  request.mutable_options()->set_min_revision(now + 1);
  for (const bool is_bulk : {false, true}) {
    if (is_bulk) request.mutable_packed_points_m()->Resize(3 * 3000, 0.5f);
    v1::QueryDistancesResponse response;
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(100));
    EXPECT_EQ(server.queries->QueryDistances(&context, request, &response).error_code(), grpc::DEADLINE_EXCEEDED);
  }
  for (const bool is_bulk : {true, false}) {
    if (!is_bulk) request.mutable_packed_points_m()->Truncate(3);
    request.mutable_options()->set_min_revision(Last() + 1);
    ASSERT_TRUE(Eventually([&] { return inflight->used_bytes() == 0; }));
    std::thread writer([&] {
      EXPECT_TRUE(Eventually([&] { return inflight->used_bytes() > 0; })) << "the question has come, and waits";
      v1::UpdateSubmapRequest rename;
      rename.mutable_submap()->set_name("maps/room/submaps/1");
      rename.mutable_submap()->set_display_name(is_bulk ? "a" : "b");
      rename.mutable_update_mask()->add_paths("display_name");
      EXPECT_OK(server.Call(&SubmapStub::UpdateSubmap, rename));
    });
    const v1::QueryDistancesResponse response = Ask();
    writer.join();
    ASSERT_OK(status);
    EXPECT_EQ(response.revision(), request.options().min_revision());
    EXPECT_EQ(response.results_size(), is_bulk ? 3000 : 1);
  }
  request.set_map("maps/nowhere");
  Ask();
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
}

TEST_F(DistancesTest, MoreThanAMillionPointsAreTooMany) {
  request.mutable_packed_points_m()->Resize(3 * 1'000'001, 0);
  Ask();
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(BadFieldOf(status), "packed_points_m");
}

}  // namespace
}  // namespace dhpmap::testing
