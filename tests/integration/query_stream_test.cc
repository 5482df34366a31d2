// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "server/grpc/map_pin.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// A mapped TestScene and one stream of queries.
class QueryStreamTest : public ::testing::Test {
 protected:
  using Stream = grpc::ClientReaderWriter<v1::StreamQueriesRequest, v1::StreamQueriesResponse>;

  QueryStreamTest() {
    EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(Feed(server, "room", 0, 10));
  }
  std::unique_ptr<Stream> Open(const std::shared_ptr<grpc::Channel>& channel) {
    return v1::QueryService::NewStub(channel)->StreamQueries(&context);
  }
  static v1::StreamQueriesRequest Distance(std::int64_t number, double z_m) {
    v1::StreamQueriesRequest request;
    request.set_sequence(number);
    request.mutable_query_distances()->set_map("maps/room");
    request.mutable_query_distances()->add_points_m()->set_z(z_m);
    return request;
  }
  static v1::StreamQueriesRequest Pin(const std::string& map) {
    v1::StreamQueriesRequest request;
    request.mutable_pin()->set_map(map);
    return request;
  }
  static v1::StreamQueriesResponse Ask(Stream& stream, const v1::StreamQueriesRequest& request) {
    v1::StreamQueriesResponse response;
    EXPECT_TRUE(stream.Write(request));
    EXPECT_TRUE(stream.Read(&response));
    EXPECT_EQ(response.sequence(), request.sequence());
    return response;
  }
  std::int64_t RevisionNow() { return server.Call(&MapStub::GetMap, "maps/room").value().map().revision(); }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
  grpc::ClientContext context;
};

TEST_F(QueryStreamTest, AnswersAnyQueryUnderItsNumberAsTheCallWould) {
  ASSERT_OK_AND_ASSIGN(const auto called, server.Call(&QueryStub::QueryDistances, Distance(0, 1.3).query_distances()));
  const auto stream = Open(server.grpc().InProcessChannel());
  EXPECT_EQ(Ask(*stream, Distance(7, 1.3)).query_distances().SerializeAsString(), called.SerializeAsString());
  v1::StreamQueriesRequest request;
  request.set_sequence(8);
  request.mutable_query_points()->set_map("maps/room");
  request.mutable_query_points()->add_points_m()->set_z(0.8);
  EXPECT_EQ(Ask(*stream, request).query_points().results_size(), 1);
  request.mutable_cast_rays()->set_map("maps/room");
  v1::Ray& ray = *request.mutable_cast_rays()->add_rays();
  ray.mutable_origin_m()->set_z(2);
  ray.mutable_direction()->set_z(-1);
  EXPECT_EQ(Ask(*stream, request).cast_rays().results_size(), 1);
  request.mutable_query_occupancy_slice()->set_map("maps/room");
  request.mutable_query_occupancy_slice()->set_max_z_m(1);
  EXPECT_GT(Ask(*stream, request).query_occupancy_slice().width(), 10);
  request.mutable_search_submaps()->set_map("maps/room");
  EXPECT_GT(Ask(*stream, request).search_submaps().matches_size(), 1);
  request.mutable_query_relations()->set_map("maps/room");
  EXPECT_GT(Ask(*stream, request).query_relations().revision(), 0);
  request.mutable_check_collisions()->set_map("maps/room");
  for (const float value : {0.0F, 0.0F, 1.3F, 5.0F}) request.mutable_check_collisions()->add_packed_spheres_m(value);
  EXPECT_TRUE(Ask(*stream, request).check_collisions().results(0).colliding());
  request.mutable_check_trajectory()->set_map("maps/room");
  request.mutable_check_trajectory()->add_robot()->set_radius_m(5);
  request.mutable_check_trajectory()->add_trajectories()->add_waypoints()->mutable_rotation()->set_w(1);
  EXPECT_FALSE(Ask(*stream, request).check_trajectory().results(0).valid());
  EXPECT_TRUE(stream->WritesDone());
  v1::StreamQueriesResponse none;
  EXPECT_FALSE(stream->Read(&none));
  EXPECT_OK(stream->Finish());
}

TEST_F(QueryStreamTest, ManyQueriesSentAheadAreAnsweredInOrder) {
  const auto stream = Open(server.channel());
  constexpr int kMany = 500;
  std::thread writer([&] {
    for (int i = 0; i < kMany; ++i) EXPECT_TRUE(stream->Write(Distance(i, 0.5 + 0.001 * i)));
    stream->WritesDone();
  });
  v1::StreamQueriesResponse response;
  for (int i = 0; i < kMany; ++i) {
    ASSERT_TRUE(stream->Read(&response));
    EXPECT_EQ(response.sequence(), i);
    EXPECT_EQ(response.query_distances().results_size(), 1);
  }
  writer.join();
  EXPECT_OK(stream->Finish());
}

TEST_F(QueryStreamTest, AnInvalidQueryIsAnsweredWithItsErrorAndTheStreamContinues) {
  const auto stream = Open(server.channel());
  v1::StreamQueriesRequest bad = Distance(1, 1);
  bad.mutable_query_distances()->mutable_options()->add_class_names("spoon");
  v1::StreamQueriesResponse answer = Ask(*stream, bad);
  EXPECT_EQ(answer.error().code(), grpc::INVALID_ARGUMENT);
  EXPECT_GT(answer.error().details_size(), 0);
  EXPECT_EQ(answer.answer_case(), v1::StreamQueriesResponse::ANSWER_NOT_SET);
  EXPECT_EQ(Ask(*stream, v1::StreamQueriesRequest()).error().code(), grpc::INVALID_ARGUMENT) << "no query";
  bad = Distance(2, 1);
  bad.mutable_query_distances()->set_map("maps/nowhere");
  EXPECT_EQ(Ask(*stream, bad).error().code(), grpc::NOT_FOUND);
  bad = Distance(3, 1);
  bad.mutable_query_distances()->mutable_options()->set_min_revision(1'000'000);
  EXPECT_EQ(Ask(*stream, bad).error().code(), grpc::FAILED_PRECONDITION);
  EXPECT_EQ(Ask(*stream, Pin("room")).error().code(), grpc::INVALID_ARGUMENT);
  answer = Ask(*stream, Distance(4, 1.3));
  EXPECT_FALSE(answer.has_error());
  EXPECT_EQ(answer.query_distances().results_size(), 1);
}

TEST_F(QueryStreamTest, APinHoldsOneStateWhileTheMapChanges) {
  const auto stream = Open(server.channel());
  const std::int64_t pinned = Ask(*stream, Pin("maps/room")).pin().revision();
  EXPECT_EQ(pinned, RevisionNow());
  ASSERT_OK(Feed(server, "room", 10, 20));
  ASSERT_GT(RevisionNow(), pinned);
  EXPECT_EQ(Ask(*stream, Distance(1, 1)).query_distances().revision(), pinned);
  v1::StreamQueriesRequest points;
  points.mutable_query_points()->set_map("maps/room");
  points.mutable_query_points()->add_points_m();
  EXPECT_EQ(Ask(*stream, points).query_points().revision(), pinned);
  EXPECT_EQ(Ask(*stream, Pin("")).pin().revision(), 0);
  EXPECT_EQ(Ask(*stream, Distance(2, 1)).query_distances().revision(), RevisionNow());
}

TEST_F(QueryStreamTest, EndsWithTheServerEvenIfIdle) {
  const auto stream = Open(server.channel());
  (void)Ask(*stream, Distance(1, 1));
  server.grpc().Drain();  // neither waits nor cancels
  v1::StreamQueriesResponse none;
  EXPECT_FALSE(stream->Read(&none));
  const grpc::Status ended = stream->Finish();
  EXPECT_EQ(ended.error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(ReasonOf(ended), "SHUTTING_DOWN");
}

std::shared_ptr<const MapView> EmptyView() {
  return std::make_shared<const MapView>(Map(MapInfo{.name = "m"}).Publish(0));
}

TEST(MapPin, HoldsAStateOfOneMapUntilItIsReleased) {
  MapPin pin(std::chrono::hours(1));
  EXPECT_EQ(*pin.Of("m"), nullptr) << "nothing is held";
  auto view = EmptyView();
  const std::weak_ptr<const MapView> watch = view;
  pin.Hold("m", std::move(view));
  EXPECT_EQ(*pin.Of("m"), watch.lock());
  EXPECT_NE(*pin.Of("m"), nullptr);
  EXPECT_EQ(*pin.Of("other"), nullptr);
  pin.Release();
  EXPECT_EQ(*pin.Of("m"), nullptr);
  EXPECT_TRUE(watch.expired());
}

TEST(MapPin, ExpiresByItselfAndReportsIt) {
  MapPin pin(std::chrono::milliseconds(1));
  auto view = EmptyView();
  const std::weak_ptr<const MapView> watch = view;
  pin.Hold("m", std::move(view));
  EXPECT_TRUE(Eventually([&] { return watch.expired(); })) << "although nobody asks";
  EXPECT_EQ(*pin.Of("other"), nullptr);
  EXPECT_EQ(pin.Of("m").status().code(), StatusCode::kFailedPrecondition);
  pin.Release();
  EXPECT_EQ(*pin.Of("m"), nullptr);
}

}  // namespace
}  // namespace dhpmap::testing
