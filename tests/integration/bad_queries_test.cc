// SPDX-License-Identifier: BSD-3-Clause
// All queries refuse invalid input alike, with the field and the item, also within a stream of queries.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/integration/mapped_scene.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

constexpr int kMostItems = 100;  // of a query, for this server
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class BadQueries : public MappedScene {
 protected:
  static void SetUpTestSuite() { SetUpWith({.max_query_points = kMostItems}); }
  void SetUp() override { stream_ = server_->queries->StreamQueries(&stream_context_); }
  void TearDown() override {
    stream_context_.TryCancel();
    v1::StreamQueriesResponse none;
    while (stream_->Read(&none)) {
    }
    (void)stream_->Finish();
  }

  // Valid requests.
  static v1::QueryPointsRequest Points() { return WithPoints<v1::QueryPointsRequest>(); }
  static v1::QueryDistancesRequest Distances() { return WithPoints<v1::QueryDistancesRequest>(); }
  static v1::CastRaysRequest Rays() {
    auto request = OfRoom<v1::CastRaysRequest>();
    request.mutable_packed_origins_m()->Resize(6, 0.5f);
    request.mutable_packed_directions()->Resize(6, 1.f);
    return request;
  }
  static v1::CheckCollisionsRequest Collisions() {
    auto request = OfRoom<v1::CheckCollisionsRequest>();
    request.mutable_packed_spheres_m()->Resize(8, 0.5f);
    return request;
  }
  static v1::CheckTrajectoryRequest Packed() {
    auto request = OfRoom<v1::CheckTrajectoryRequest>();
    request.set_num_waypoints(2);
    request.set_num_spheres(1);
    request.mutable_packed_spheres_m()->Resize(8, 0.5f);
    return request;
  }
  static v1::CheckTrajectoryRequest Rigid() {
    auto request = OfRoom<v1::CheckTrajectoryRequest>();
    request.add_robot()->set_radius_m(0.1);
    for (int h = 0; h < 2; ++h) {
      if (h == 0) request.add_trajectories();
      request.mutable_trajectories(0)->add_waypoints()->mutable_translation_m()->set_z(2);
    }
    return request;
  }
  static v1::QueryOccupancySliceRequest Slice() {
    auto request = OfRoom<v1::QueryOccupancySliceRequest>();
    request.set_max_z_m(1);
    return request;
  }
  static v1::QueryDistanceGridRequest Grid() {
    auto request = OfRoom<v1::QueryDistanceGridRequest>();
    request.mutable_box()->mutable_max_m()->set_x(1);
    request.set_resolution_m(0.25);
    return request;
  }
  static v1::SearchSubmapsRequest Search() { return OfRoom<v1::SearchSubmapsRequest>(); }
  static v1::QueryRelationsRequest Relations() { return OfRoom<v1::QueryRelationsRequest>(); }

  /// Calls visit(request) with a valid request of each query that takes options.
  template <typename Visit>
  static void ForEachWithOptions(const Visit& visit) {
    visit(Distances()), visit(Rays()), visit(Collisions()), visit(Packed()), visit(Rigid()), visit(Slice());
    visit(Grid()), visit(Search()), visit(Relations());
  }

  grpc::Status Ask(const v1::QueryPointsRequest& r) { return server_->Call(&QueryStub::QueryPoints, r).status(); }
  grpc::Status Ask(const v1::QueryDistancesRequest& r) { return server_->Call(&QueryStub::QueryDistances, r).status(); }
  grpc::Status Ask(const v1::CastRaysRequest& r) { return server_->Call(&QueryStub::CastRays, r).status(); }
  grpc::Status Ask(const v1::CheckCollisionsRequest& r) {
    return server_->Call(&QueryStub::CheckCollisions, r).status();
  }
  grpc::Status Ask(const v1::CheckTrajectoryRequest& r) {
    return server_->Call(&QueryStub::CheckTrajectory, r).status();
  }
  grpc::Status Ask(const v1::QueryOccupancySliceRequest& r) {
    return server_->Call(&QueryStub::QueryOccupancySlice, r).status();
  }
  grpc::Status Ask(const v1::SearchSubmapsRequest& r) { return server_->Call(&QueryStub::SearchSubmaps, r).status(); }
  grpc::Status Ask(const v1::QueryRelationsRequest& r) { return server_->Call(&QueryStub::QueryRelations, r).status(); }
  grpc::Status Ask(const v1::QueryDistanceGridRequest& r) {
    return server_->Call(&QueryStub::QueryDistanceGrid, r).status();
  }

  /// Expects that the call and a stream, which continues, refuse the request with the code, a reason, and a violation
  /// with this beginning.
  template <typename Request>
  void ExpectRefused(const Request& request, grpc::StatusCode code, const std::string& violation) {
    SCOPED_TRACE(Request::descriptor()->name() + ": " + violation);
    const grpc::Status status = Ask(request);
    EXPECT_EQ(status.error_code(), code) << status.error_message();
    EXPECT_FALSE(ReasonOf(status).empty());
    EXPECT_EQ(ViolationOf(status).substr(0, violation.size()), violation) << ViolationOf(status);
    if constexpr (!std::is_same_v<Request, v1::QueryDistanceGridRequest>) {
      const google::rpc::Status streamed = AskInStream(request);
      EXPECT_EQ(streamed.code(), static_cast<int>(code)) << streamed.message();
      EXPECT_EQ(ViolationOf(streamed), ViolationOf(status));
    }
  }
  template <typename Request>
  void ExpectRefused(const Request& request, const std::string& violation) {
    ExpectRefused(request, grpc::INVALID_ARGUMENT, violation);
  }

 private:
  template <typename Request>
  static Request OfRoom() {
    Request request;
    request.set_map("maps/room");
    return request;
  }
  template <typename Request>
  static Request WithPoints() {
    auto request = OfRoom<Request>();
    request.mutable_packed_points_m()->Resize(6, 0.5f);
    request.add_points_m();
    return request;
  }
  static void Put(const v1::QueryPointsRequest& r, v1::StreamQueriesRequest& to) { *to.mutable_query_points() = r; }
  static void Put(const v1::QueryDistancesRequest& r, v1::StreamQueriesRequest& to) {
    *to.mutable_query_distances() = r;
  }
  static void Put(const v1::CastRaysRequest& r, v1::StreamQueriesRequest& to) { *to.mutable_cast_rays() = r; }
  static void Put(const v1::CheckCollisionsRequest& r, v1::StreamQueriesRequest& to) {
    *to.mutable_check_collisions() = r;
  }
  static void Put(const v1::CheckTrajectoryRequest& r, v1::StreamQueriesRequest& to) {
    *to.mutable_check_trajectory() = r;
  }
  static void Put(const v1::QueryOccupancySliceRequest& r, v1::StreamQueriesRequest& to) {
    *to.mutable_query_occupancy_slice() = r;
  }
  static void Put(const v1::SearchSubmapsRequest& r, v1::StreamQueriesRequest& to) { *to.mutable_search_submaps() = r; }
  static void Put(const v1::QueryRelationsRequest& r, v1::StreamQueriesRequest& to) {
    *to.mutable_query_relations() = r;
  }
  template <typename Request>
  google::rpc::Status AskInStream(const Request& query) {
    v1::StreamQueriesRequest request;
    request.set_sequence(++number_);
    Put(query, request);
    v1::StreamQueriesResponse response;
    EXPECT_TRUE(stream_->Write(request));
    EXPECT_TRUE(stream_->Read(&response));
    EXPECT_EQ(response.sequence(), number_);
    return response.error();
  }

  grpc::ClientContext stream_context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::StreamQueriesRequest, v1::StreamQueriesResponse>> stream_;
  std::int64_t number_ = 0;
};

TEST_F(BadQueries, ValidQueriesAreAnswered) {
  EXPECT_OK(Ask(Points()));
  ForEachWithOptions([this](const auto& request) {
    const grpc::Status status = Ask(request);
    EXPECT_OK(status) << request.GetTypeName() << ViolationOf(status);
  });
}

TEST_F(BadQueries, InvalidMapsAreRefusedByEachQuery) {
  const auto of_map = [this](auto request) {
    request.set_map("maps/nowhere");
    const grpc::Status unknown = Ask(request);
    EXPECT_EQ(unknown.error_code(), grpc::NOT_FOUND) << request.GetTypeName();
    EXPECT_EQ(ReasonOf(unknown), "MAP_NOT_FOUND") << request.GetTypeName();
    for (const char* name : {"", "room", "maps/Room", "maps/room/submaps/1"}) {
      request.set_map(name);
      ExpectRefused(request, "map '");
    }
  };
  of_map(Points());
  ForEachWithOptions(of_map);
}

TEST_F(BadQueries, EachQueryNamesInvalidOptionsAndTheirItem) {
  struct Case {
    std::function<void(v1::QueryOptions&)> spoil;
    std::string violation;
    grpc::StatusCode code = grpc::INVALID_ARGUMENT;
  };
  const std::string ball = ObjectOfClass(1);
  ASSERT_FALSE(ball.empty());
  const double nan = kNan, infinity = std::numeric_limits<double>::infinity();
  const Case cases[] = {
      {[](auto& o) { o.mutable_map_from_query()->mutable_rotation(); }, "options.map_from_query has a zero quaternion"},
      {[=](auto& o) { o.mutable_map_from_query()->mutable_rotation()->set_w(nan); },
       "options.map_from_query has a NaN"},
      {[=](auto& o) { o.mutable_map_from_query()->mutable_translation_m()->set_y(infinity); },
       "options.map_from_query has a NaN"},
      {[=](auto& o) { o.set_max_distance_m(nan); }, "options.max_distance_m "},
      {[](auto& o) { o.set_max_distance_m(-1); }, "options.max_distance_m "},
      {[](auto& o) { o.set_min_revision(-1); }, "options.min_revision "},
      {[](auto& o) { o.set_unknown_policy(static_cast<v1::QueryOptions::UnknownPolicy>(77)); },
       "options.unknown_policy "},
      {[](auto& o) {
         o.add_excluded_submaps("maps/room/submaps/0");
         o.add_excluded_submaps("maps/room/submaps/4000000");
       },
       "options.excluded_submaps[1] ", grpc::NOT_FOUND},
      {[](auto& o) { o.add_excluded_submaps("maps/hall/submaps/0"); }, "options.excluded_submaps[0] is a submap of"},
      {[](auto& o) { o.add_excluded_submaps("maps/room/submaps/x"); }, "options.excluded_submaps[0] '"},
      {[](auto& o) {
         for (int i = 0; i <= 1000; ++i) o.add_excluded_submaps("maps/room/submaps/0");
       },
       "options.excluded_submaps 1001 "},
      {[](auto& o) {
         o.add_excluded_class_names("thing1");
         o.add_excluded_class_names("spoon");
       },
       "options.excluded_class_names[1] "},
      {[](auto& o) {
         o.add_class_names("thing1");
         o.add_class_names("spoon");
       },
       "options.class_names[1] "},
      {[&](auto& o) {
         o.add_attached()->set_submap(ball);
         o.add_attached()->set_submap("maps/room/submaps/4000000");
       },
       "options.attached[1].submap ", grpc::NOT_FOUND},
      {[](auto& o) { o.add_attached()->set_submap("maps/room/submaps/0"); }, "options.attached[0].submap "},
  };
  for (const Case& c : cases) {
    ForEachWithOptions([&](auto request) {
      c.spoil(*request.mutable_options());
      ExpectRefused(request, c.code, c.violation);
    });
  }
}

TEST_F(BadQueries, OptionsOfSomeQueriesAreNamedByThoseQueries) {
  struct Case {
    std::function<void(v1::QueryOptions&)> spoil;
    std::string violation;
    grpc::StatusCode code = grpc::INVALID_ARGUMENT;
  };
  const Case cases[] = {
      {[](auto& o) { o.mutable_padding()->set_default_padding_m(-0.1); }, "options.padding.default_padding_m "},
      {[](auto& o) { o.mutable_padding()->set_default_padding_m(kNan); }, "options.padding.default_padding_m "},
      {[](auto& o) {
         for (const char* name : {"thing1", "spoon"}) o.mutable_padding()->add_classes()->set_class_name(name);
       },
       "options.padding.classes[1].class_name "},
      {[](auto& o) {
         o.mutable_padding()->add_classes()->set_class_name("thing1");
         o.mutable_padding()->mutable_classes(0)->set_padding_m(11);
       },
       "options.padding.classes[0].padding_m "},
      {[](auto& o) {
         for (const char* id : {"0", "4000000"}) {
           o.mutable_padding()->add_submaps()->set_submap(std::string("maps/room/submaps/") + id);
         }
       },
       "options.padding.submaps[1].submap ", grpc::NOT_FOUND},
      {[](auto& o) { o.set_max_free_age_s(-1); }, "options.max_free_age_s "},
      {[](auto& o) { o.set_vacated_policy(static_cast<v1::Vacated::Policy>(77)); }, "options.vacated_policy "},
  };
  const auto expect_all_refused = [&](const auto& sound) {
    for (const Case& c : cases) {
      auto request = sound;
      c.spoil(*request.mutable_options());
      ExpectRefused(request, c.code, c.violation);
    }
  };
  expect_all_refused(Distances()), expect_all_refused(Collisions()), expect_all_refused(Grid());
  expect_all_refused(Packed()), expect_all_refused(Rigid());
}

TEST_F(BadQueries, InvalidItemsOfEachQueryAreNamedByTheirNumber) {
  const auto spoilt = [](auto request, const auto& spoil) {
    spoil(request);
    return request;
  };
  const auto points = [&](const auto& sound) {
    ExpectRefused(spoilt(sound, [](auto& r) { r.set_packed_points_m(4, kNan); }), "packed_points_m point 1 ");
    ExpectRefused(spoilt(sound, [](auto& r) { r.mutable_points_m(0)->set_z(kNan); }), "points_m[0] ");
    ExpectRefused(spoilt(sound, [](auto& r) { r.add_packed_points_m(1); }), "packed_points_m has 7 values");
    ExpectRefused(spoilt(sound, [](auto& r) { r.mutable_packed_points_m()->Resize(3 * kMostItems, 0); }),
                  "packed_points_m 101 points");
  };
  points(Points()), points(Distances());
  ExpectRefused(spoilt(Rays(), [](auto& r) { r.set_packed_directions(3, kNan); }), "packed_directions ray 1 ");
  ExpectRefused(spoilt(Rays(), [](auto& r) { r.set_packed_origins_m(3, kNan); }), "packed_directions ray 1 ");
  ExpectRefused(spoilt(Rays(),
                       [](auto& r) {
                         r.mutable_packed_origins_m()->Resize(3 * kMostItems + 3, 0);
                         r.mutable_packed_directions()->Resize(3 * kMostItems + 3, 1);
                       }),
                "packed_directions 101 rays");
  ExpectRefused(spoilt(Rays(), [](auto& r) { r.add_rays(); }), "rays[0] ");
  ExpectRefused(spoilt(Collisions(), [](auto& r) { r.set_packed_spheres_m(7, -1); }), "packed_spheres_m sphere 1 ");
  ExpectRefused(spoilt(Collisions(), [](auto& r) { r.set_packed_spheres_m(4, kNan); }), "packed_spheres_m sphere 1 ");
  ExpectRefused(spoilt(Collisions(), [](auto& r) { r.mutable_packed_spheres_m()->Resize(4 * kMostItems + 4, 0); }),
                "packed_spheres_m 101 bodies");
  ExpectRefused(spoilt(Collisions(),
                       [](auto& r) {
                         r.add_bodies()->mutable_sphere();
                         r.add_bodies()->mutable_box()->mutable_pose()->mutable_rotation();
                       }),
                "bodies[1].box.pose has a zero quaternion");
  ExpectRefused(spoilt(Packed(), [](auto& r) { r.set_packed_spheres_m(7, -1); }), "packed_spheres_m sphere 1 ");
  ExpectRefused(spoilt(Packed(), [](auto& r) { r.mutable_packed_spheres_m()->Resize(4 * kMostItems + 8, 0); }),
                "packed_spheres_m 102 spheres");
  ExpectRefused(spoilt(Rigid(), [](auto& r) { r.mutable_trajectories(0)->mutable_waypoints(1)->mutable_rotation(); }),
                "trajectories[0].waypoints[1] has a zero quaternion");
  ExpectRefused(spoilt(Rigid(), [](auto& r) { r.add_robot()->set_radius_m(-1); }), "robot[1] ");
  ExpectRefused(spoilt(Slice(), [](auto& r) { r.set_min_z_m(kNan); }), "min_z_m ");
  ExpectRefused(spoilt(Grid(), [](auto& r) { r.mutable_box()->mutable_min_m()->set_y(kNan); }), "box.min_m ");
  ExpectRefused(spoilt(Search(), [](auto& r) { r.mutable_sphere()->set_radius_m(-1); }), "sphere.radius_m ");
  ExpectRefused(spoilt(Search(), [](auto& r) { r.mutable_near_point_m()->set_x(kNan); }), "near_point_m ");
  ExpectRefused(spoilt(Search(), [](auto& r) { r.mutable_region()->mutable_max_m()->set_x(kNan); }), "region.max_m ");
  ExpectRefused(spoilt(Relations(), [](auto& r) { r.set_submap("maps/room/submaps/4000000"); }), grpc::NOT_FOUND,
                "submap ");
  ExpectRefused(spoilt(Relations(), [](auto& r) { r.set_max_gap_m(kNan); }), "max_gap_m ");
}

}  // namespace
}  // namespace dhpmap::testing
