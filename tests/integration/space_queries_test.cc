// SPDX-License-Identifier: BSD-3-Clause
// Slices, grids, objects and streams of queries on a mapped TestScene, through both doors.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "tests/integration/mapped_scene.h"

namespace dhpmap::testing {
namespace {

class SpaceQueries : public MappedScene {
 protected:
  static void SetUpTestSuite() { SetUpWith({}, 40); }
  /// The two doors: TCP, and the channel that REST uses.
  static std::vector<std::shared_ptr<grpc::Channel>> Doors() {
    return {server_->channel(), server_->grpc().InProcessChannel()};
  }

  /// Queries both doors, whose answers must be equal.
  template <typename Request, typename Response>
  Response Ask(Client::Unary<QueryStub, Request, Response> method, const Request& request) {
    Response response;
    std::string first;
    for (const auto& channel : Doors()) {
      response = Client(channel).Call(method, request).KeepStatus(status);
      if (first.empty()) first = response.SerializeAsString();
      EXPECT_EQ(response.SerializeAsString(), first);
    }
    return response;
  }
  v1::QueryOccupancySliceResponse Slice(const v1::QueryOccupancySliceRequest& request) {
    return Ask(&QueryStub::QueryOccupancySlice, request);
  }
  static v1::QueryOccupancySliceRequest SliceRequest(double min_z_m, double max_z_m) {
    v1::QueryOccupancySliceRequest request;
    request.set_map("maps/room");
    request.set_min_z_m(min_z_m);
    request.set_max_z_m(max_z_m);
    return request;
  }
  /// Distances at the nodes of a box, all messages joined.
  v1::QueryDistanceGridResponse Grid(const v1::QueryDistanceGridRequest& request) {
    v1::QueryDistanceGridResponse all;
    const auto parts = server_->Call(&QueryStub::QueryDistanceGrid, request).KeepStatus(status);
    num_parts = static_cast<int>(parts.size());
    for (const auto& part : parts) {
      EXPECT_EQ(part.first_node(), all.distance_m_size());
      all.MergeFrom(part);
    }
    return all;
  }
  static v1::QueryDistanceGridRequest GridRequest() {
    v1::QueryDistanceGridRequest request;
    request.set_map("maps/room");
    auto& low = *request.mutable_box()->mutable_min_m();
    auto& high = *request.mutable_box()->mutable_max_m();
    low.set_x(-0.6), low.set_y(-0.5), low.set_z(0.1);
    high.set_x(0.6), high.set_y(0.5), high.set_z(1.0);
    request.set_resolution_m(0.05);
    return request;
  }
  void ExpectRefused(grpc::StatusCode code, const std::string& field) {
    EXPECT_EQ(status.error_code(), code) << field;
    EXPECT_EQ(BadFieldOf(status), field);
  }

  grpc::Status status;
  int num_parts = 0;
};

TEST_F(SpaceQueries, ASliceShowsTheScene) {
  v1::QueryOccupancySliceRequest request = SliceRequest(0.1, 0.6);
  request.set_include_objects(true);
  const auto slice = Slice(request);
  ASSERT_OK(status);
  ASSERT_EQ(slice.cells().size(), static_cast<std::size_t>(slice.width()) * static_cast<std::size_t>(slice.height()));
  ASSERT_EQ(slice.object_indices_size(), slice.width() * slice.height());
  const auto at = [&slice](double x_m, double y_m) {
    const int x = static_cast<int>(std::floor((x_m - slice.origin_m().x()) / slice.resolution_m()));
    const int y = static_cast<int>(std::floor((y_m - slice.origin_m().y()) / slice.resolution_m()));
    return static_cast<std::size_t>(y * slice.width() + x);
  };
  const auto cell = [&](double x_m, double y_m) {
    return static_cast<int>(static_cast<signed char>(slice.cells()[at(x_m, y_m)]));
  };
  EXPECT_EQ(cell(0.39, 0), 100) << "the ball's equator";
  EXPECT_EQ(cell(1.2, 0.06), 100) << "the box's side";
  EXPECT_EQ(cell(0.7, -0.4), 0) << "between and before them";
  EXPECT_NE(cell(0, 0), 0) << "nobody looked into the ball";
  const std::uint32_t ball = slice.object_indices(static_cast<int>(at(0.39, 0)));
  const std::uint32_t box = slice.object_indices(static_cast<int>(at(1.2, 0.06)));
  ASSERT_GT(ball, 0u);
  ASSERT_GT(box, 0u);
  EXPECT_NE(ball, box);
  EXPECT_GT(slice.objects(static_cast<int>(ball) - 1).instance_id(), 0);
  EXPECT_EQ(slice.object_indices(static_cast<int>(at(0.7, -0.4))), 0u);
  request.mutable_options()->add_excluded_submaps(slice.objects(static_cast<int>(ball) - 1).submap());
  request.mutable_area()->set_min_x_m(0.36);
  request.mutable_area()->set_max_x_m(0.40);
  request.mutable_area()->set_min_y_m(-0.02);
  request.mutable_area()->set_max_y_m(0.02);
  EXPECT_NE(Slice(request).cells(), "\x64") << "without the ball";
}

TEST_F(SpaceQueries, SlicesAreServedAsImagesWithTheirYaml) {
  v1::QueryOccupancySliceRequest request = SliceRequest(0.1, 0.6);
  const auto cells = Slice(request);
  request.set_format(v1::QueryOccupancySliceRequest::PGM);
  const auto pgm = Slice(request);
  EXPECT_EQ(pgm.content_type(), "image/x-portable-graymap");
  EXPECT_TRUE(pgm.data().starts_with("P5\n")) << pgm.data().substr(0, 20);
  EXPECT_EQ(pgm.data().size() - pgm.data().find("255\n") - 4, cells.cells().size());
  EXPECT_TRUE(pgm.cells().empty());
  EXPECT_NE(pgm.yaml().find("image: 'room.pgm'"), std::string::npos) << pgm.yaml();
  request.set_format(v1::QueryOccupancySliceRequest::PNG);
  EXPECT_TRUE(Slice(request).data().starts_with("\x89PNG"));
  request.set_format(v1::QueryOccupancySliceRequest::YAML);
  request.set_yaml_image_path("floor 1.pgm");
  const auto yaml = Slice(request);
  EXPECT_NE(yaml.data().find("image: 'floor 1.pgm'"), std::string::npos) << yaml.data();
  EXPECT_EQ(yaml.content_type(), "application/yaml");
  EXPECT_EQ(yaml.width(), cells.width());
}

TEST_F(SpaceQueries, BadSlicesAreRefusedByField) {
  const double nan = std::nan("");
  const std::pair<const char*, std::function<void(v1::QueryOccupancySliceRequest&)>> bad[] = {
      {"max_z_m", [](auto& r) { r.set_max_z_m(0.1); }},
      {"resolution_m", [](auto& r) { r.set_resolution_m(0); }},
      {"resolution_m", [=](auto& r) { r.set_resolution_m(nan); }},
      {"min_free_fraction", [](auto& r) { r.set_min_free_fraction(1.5); }},
      {"area.max_x_m", [](auto& r) { r.mutable_area()->set_max_x_m(-1); }},
      {"area",
       [](auto& r) {
         r.mutable_area()->set_max_x_m(9e5);
         r.mutable_area()->set_max_y_m(9e5);
       }},
      {"max_z_m",
       [](auto& r) {
         r.mutable_area()->set_max_x_m(60);
         r.mutable_area()->set_max_y_m(60);
         r.set_max_z_m(1e5);
       }},
      {"format", [](auto& r) { r.set_format(static_cast<v1::QueryOccupancySliceRequest::Format>(77)); }},
      {"yaml_image_path", [](auto& r) { r.set_yaml_image_path("a\nb"); }},
      {"options.padding", [](auto& r) { r.mutable_options()->mutable_padding()->set_default_padding_m(1); }}};
  for (const auto& [field, spoil] : bad) {
    v1::QueryOccupancySliceRequest request = SliceRequest(0.1, 0.6);
    spoil(request);
    Slice(request);
    ExpectRefused(grpc::INVALID_ARGUMENT, field);
  }
  Slice(SliceRequest(900, 901));
  ExpectRefused(grpc::FAILED_PRECONDITION, "area");
}

TEST_F(SpaceQueries, AGridContainsTheDistancesAtItsNodes) {
  v1::QueryDistanceGridRequest request = GridRequest();
  request.set_include_gradients(true);
  request.set_include_objects(true);
  const auto grid = Grid(request);
  ASSERT_OK(status);
  ASSERT_EQ(grid.num_x(), 25);
  ASSERT_EQ(grid.num_y(), 21);
  ASSERT_EQ(grid.num_z(), 19);
  EXPECT_EQ(num_parts, 3) << "of 4,096 nodes";
  v1::QueryDistancesRequest points;
  points.set_map("maps/room");
  points.set_packed(true);
  for (int k = 0; k < 19; ++k) {
    for (int j = 0; j < 21; ++j) {
      for (int i = 0; i < 25; ++i) {
        for (const double value : {-0.6 + 0.05 * i, -0.5 + 0.05 * j, 0.1 + 0.05 * k}) {
          points.add_packed_points_m(static_cast<float>(value));
        }
      }
    }
  }
  const auto one_by_one = Ask(&QueryStub::QueryDistances, points).packed();
  ASSERT_EQ(grid.distance_m_size(), one_by_one.distance_m_size());
  ASSERT_EQ(grid.gradient_size(), 3 * grid.distance_m_size());
  ASSERT_EQ(grid.status_size(), grid.distance_m_size());
  ASSERT_EQ(grid.instance_id_size(), grid.distance_m_size());
  for (int n = 0; n < grid.distance_m_size(); ++n) {
    EXPECT_NEAR(std::abs(grid.distance_m(n)), std::abs(one_by_one.distance_m(n)), 1e-5);
  }
}

TEST_F(SpaceQueries, BadGridsAreRefusedByField) {
  const std::pair<const char*, std::function<void(v1::QueryDistanceGridRequest&)>> bad[] = {
      {"resolution_m", [](auto& r) { r.clear_resolution_m(); }},
      {"box.max_m", [](auto& r) { r.mutable_box()->mutable_max_m()->set_z(-9); }},
      {"box", [](auto& r) { r.mutable_box()->mutable_max_m()->set_x(1e5); }},
      {"options.min_revision", [](auto& r) { r.mutable_options()->set_min_revision(1); }}};
  for (const auto& [field, spoil] : bad) {
    v1::QueryDistanceGridRequest request = GridRequest();
    spoil(request);
    Grid(request);
    ExpectRefused(grpc::INVALID_ARGUMENT, field);
  }
}

TEST_F(SpaceQueries, ObjectsAreFoundAndRelated) {
  v1::SearchSubmapsRequest search;
  search.set_map("maps/room");
  search.mutable_near_point_m()->set_z(1.0);
  search.set_page_size(2);
  const auto found = Ask(&QueryStub::SearchSubmaps, search);
  ASSERT_OK(status);
  ASSERT_EQ(found.matches_size(), 2);
  const v1::SubmapMatch& ball = found.matches(0);
  EXPECT_NEAR(ball.distance_m(), 0.2, 0.03);
  EXPECT_NEAR(ball.nearest_point_m().z(), 0.8, 0.03);
  EXPECT_NEAR(ball.box().max_m().z(), 0.8, 0.05);
  EXPECT_LE(ball.distance_m(), found.matches(1).distance_m());
  search.mutable_options()->add_excluded_submaps(ball.submap().name());
  EXPECT_NE(Ask(&QueryStub::SearchSubmaps, search).matches(0).submap().name(), ball.submap().name());

  v1::QueryRelationsRequest relate;
  relate.set_map("maps/room");
  const auto relations = Ask(&QueryStub::QueryRelations, relate);
  ASSERT_OK(status);
  std::set<std::pair<std::string, int>> told;
  for (const v1::Relation& relation : relations.relations()) told.emplace(relation.subject(), relation.kind());
  EXPECT_TRUE(told.contains({ball.submap().name(), v1::Relation::ON})) << relations.ShortDebugString();
  for (const v1::Relation& relation : relations.relations()) EXPECT_NE(relation.kind(), v1::Relation::IN);
}

TEST_F(SpaceQueries, PagesOfMatchesAndRelationsFormTheCompleteLists) {
  v1::SearchSubmapsRequest search;
  search.set_map("maps/room");
  search.mutable_near_point_m()->set_z(1.0);
  const auto all = Ask(&QueryStub::SearchSubmaps, search);
  ASSERT_GT(all.matches_size(), 1);
  EXPECT_EQ(all.next_page_token(), "");
  search.set_page_size(1);
  for (int i = 0; i < all.matches_size(); ++i) {
    const auto page = Ask(&QueryStub::SearchSubmaps, search);
    ASSERT_OK(status);
    ASSERT_EQ(page.matches_size(), 1);
    EXPECT_EQ(page.matches(0).submap().name(), all.matches(i).submap().name());
    EXPECT_EQ(page.next_page_token().empty(), i + 1 == all.matches_size());
    search.set_page_token(page.next_page_token());
  }
  v1::QueryRelationsRequest relate;
  relate.set_map("maps/room");
  const auto relations = Ask(&QueryStub::QueryRelations, relate);
  relate.set_page_size(1);
  for (const v1::Relation& relation : relations.relations()) {
    const auto page = Ask(&QueryStub::QueryRelations, relate);
    ASSERT_EQ(page.relations_size(), 1);
    EXPECT_EQ(page.relations(0).ShortDebugString(), relation.ShortDebugString());
    relate.set_page_token(page.next_page_token());
  }
  EXPECT_EQ(relate.page_token(), "");
  relate.set_page_token("1-2-3");
  (void)Ask(&QueryStub::QueryRelations, relate);
  EXPECT_EQ(ReasonOf(status), "BAD_PAGE_TOKEN");
}

TEST_F(SpaceQueries, InvalidObjectQueriesAreRefusedByField) {
  const std::pair<const char*, std::function<void(v1::SearchSubmapsRequest&)>> bad[] = {
      {"page_size", [](auto& r) { r.set_page_size(-1); }},
      {"near_point_m", [](auto& r) { r.mutable_near_point_m()->set_x(std::numeric_limits<double>::infinity()); }},
      {"region.max_m", [](auto& r) { r.mutable_region()->mutable_max_m()->set_x(-1); }},
      {"name_part", [](auto& r) { r.set_name_part(std::string(201, 'x')); }}};
  for (const auto& [field, spoil] : bad) {
    v1::SearchSubmapsRequest request;
    request.set_map("maps/room");
    spoil(request);
    Ask(&QueryStub::SearchSubmaps, request);
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << field;
    EXPECT_EQ(BadFieldOf(status), field);
  }
  v1::QueryRelationsRequest request;
  request.set_map("maps/room");
  request.set_min_support(0);
  Ask(&QueryStub::QueryRelations, request);
  ExpectRefused(grpc::INVALID_ARGUMENT, "min_support");
  request.clear_min_support();
  request.add_kinds(v1::Relation::KIND_UNSPECIFIED);
  Ask(&QueryStub::QueryRelations, request);
  ExpectRefused(grpc::INVALID_ARGUMENT, "kinds[0]");
}

}  // namespace
}  // namespace dhpmap::testing
