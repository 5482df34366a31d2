// SPDX-License-Identifier: BSD-3-Clause
// Every query before and after a restart, on a map with free space, a removed object and a moved one.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "mapping/paging/page_reader.h"
#include "mapping/paging/tile_page.h"
#include "tests/integration/server_on_file.h"
#include "tests/integration/walked_room.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// A server on a file, with a room from which the chair was removed.
class RestartAnswers : public ServerOnFile {
 protected:
  void MapUntilTheChairIsGone() {
    CreateWalkedMap(*server, "room");
    Walk(*server, "room", WalkedRoom(true, true), 0, 12);
    Walk(*server, "room", WalkedRoom(false, true), 12, 26);
    ASSERT_OK(server->Call(&MappingStub::FinishMapping, "maps/room"));
  }
  void MoveTheCrate(double x_m) {
    v1::UpdateSubmapRequest request;
    request.mutable_submap()->set_name(ListedOfClass(*server, "room", kCrateClass).name());
    request.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_x(x_m);
    request.mutable_update_mask()->add_paths("map_from_submap");
    ASSERT_OK(server->Call(&SubmapStub::UpdateSubmap, request));
  }

  template <typename Request, typename Response>
  Response Ask(Client::Unary<QueryStub, Request, Response> method, Request request) {
    request.set_map("maps/room");
    return server->Call(method, request).value();
  }
  /// Calls visit(x, y, z) for places all over the room, also behind its walls.
  template <typename Visit>
  static void ForEachPlace(double step_m, const Visit& visit) {
    const auto num_steps = [step_m](double length_m) { return static_cast<int>(length_m / step_m) + 1; };
    for (int i = 0; i < num_steps(3.2); ++i) {
      for (int j = 0; j < num_steps(3.3); ++j) {
        for (int k = 0; k < num_steps(1.4); ++k) visit(0.1 + step_m * i, step_m * j - 1, step_m * k - 0.1);
      }
    }
  }
  v1::QueryPointsResponse Points() {
    v1::QueryPointsRequest request;
    request.set_packed(true);
    ForEachPlace(0.09, [&](double x, double y, double z) {
      for (const double value : {x, y, z}) request.add_packed_points_m(static_cast<float>(value));
    });
    return Ask(&QueryStub::QueryPoints, request);
  }
  v1::QueryDistancesResponse Distances(v1::Vacated::Policy vacated) {
    v1::QueryDistancesRequest request;
    request.set_packed(true);
    request.mutable_options()->set_vacated_policy(vacated);
    ForEachPlace(0.11, [&](double x, double y, double z) {
      for (const double value : {x, y, z}) request.add_packed_points_m(static_cast<float>(value));
    });
    return Ask(&QueryStub::QueryDistances, request);
  }
  v1::CastRaysResponse Rays() {
    v1::CastRaysRequest request;
    request.set_packed(true);
    for (const float value : {0.2f, 0.3f, 1.2f}) request.add_packed_origins_m(value);
    for (int i = 0; i < 300; ++i) {
      const int column = i % 60, row = i / 60;
      const double azimuth = 0.021 * column - 0.6, elevation = 0.2 * row - 0.7;
      for (const double value : {std::cos(azimuth), std::sin(azimuth), std::tan(elevation)}) {
        request.add_packed_directions(static_cast<float>(value));
      }
    }
    return Ask(&QueryStub::CastRays, request);
  }
  v1::CheckCollisionsResponse Collisions() {
    v1::CheckCollisionsRequest request;
    request.set_packed(true);
    ForEachPlace(0.23, [&](double x, double y, double z) {
      for (const double value : {x, y, z, 0.12}) request.add_packed_spheres_m(static_cast<float>(value));
    });
    return Ask(&QueryStub::CheckCollisions, request);
  }
  v1::CheckTrajectoryResponse Trajectories() {
    v1::CheckTrajectoryRequest request;
    request.set_all_contacts(true);
    for (const double z : {0.2, 0.6}) {
      v1::Sphere& sphere = *request.add_robot();
      sphere.mutable_center_m()->set_z(z);
      sphere.set_radius_m(0.15);
    }
    for (int i = 0; i < 12; ++i) {
      v1::Trajectory& trajectory = *request.add_trajectories();
      for (const double x : {0.4, 1.7, 2.9}) {
        v1::Vector3& at_m = *trajectory.add_waypoints()->mutable_translation_m();
        at_m.set_x(x);
        at_m.set_y(0.2 + 0.15 * i * (x - 1.2));
      }
    }
    return Ask(&QueryStub::CheckTrajectory, request);
  }
  v1::QueryOccupancySliceResponse Slice() {
    v1::QueryOccupancySliceRequest request;
    request.set_min_z_m(0.15);
    request.set_max_z_m(0.9);
    request.set_include_objects(true);
    return Ask(&QueryStub::QueryOccupancySlice, request);
  }
  v1::SearchSubmapsResponse Search() {
    v1::SearchSubmapsRequest request;
    request.mutable_near_point_m()->set_x(1);
    request.mutable_near_point_m()->set_z(1);
    return Ask(&QueryStub::SearchSubmaps, request);
  }
  v1::QueryRelationsResponse Relations() { return Ask(&QueryStub::QueryRelations, v1::QueryRelationsRequest()); }
  std::string Grid() {
    v1::QueryDistanceGridRequest request;
    request.set_map("maps/room");
    request.mutable_box()->mutable_max_m()->set_x(3.2);
    request.mutable_box()->mutable_max_m()->set_y(2.2);
    request.mutable_box()->mutable_max_m()->set_z(1.2);
    request.set_resolution_m(0.1);
    request.set_include_gradients(true);
    request.set_include_objects(true);
    std::string bytes;
    for (const auto& part : server->Call(&QueryStub::QueryDistanceGrid, request).value()) {
      bytes += part.SerializeAsString();
    }
    return bytes;
  }
  v1::ListSubmapsResponse Submaps() { return server->Call(&SubmapStub::ListSubmaps, "maps/room").value(); }
  std::map<std::string, std::string> AllBytes() {
    return {{"points", Points().SerializeAsString()},
            {"distances", Distances(v1::Vacated::UNKNOWN).SerializeAsString()},
            {"distances with what was left free", Distances(v1::Vacated::FREE).SerializeAsString()},
            {"rays", Rays().SerializeAsString()},
            {"collisions", Collisions().SerializeAsString()},
            {"trajectories", Trajectories().SerializeAsString()},
            {"slice", Slice().SerializeAsString()},
            {"grid", Grid()},
            {"search", WithoutBoxes(Search())},
            {"relations", Relations().SerializeAsString()},
            {"submaps", WithoutBoxes(Submaps())},
            {"submaps with their boxes", SubmapsOneByOne()}};
  }

 private:
  /// Lists contain boxes only if they need not read voxels from disk for them.
  static void ClearBox(v1::Submap& submap) {
    submap.clear_oriented_box();
    submap.clear_footprint();
    submap.clear_support_height_m();
  }
  static std::string WithoutBoxes(v1::ListSubmapsResponse list) {
    for (v1::Submap& submap : *list.mutable_submaps()) ClearBox(submap);
    return list.SerializeAsString();
  }
  static std::string WithoutBoxes(v1::SearchSubmapsResponse found) {
    for (auto& match : *found.mutable_matches()) ClearBox(*match.mutable_submap());
    return found.SerializeAsString();
  }
  std::string SubmapsOneByOne() {
    std::string bytes;
    int num_boxes = 0;
    const v1::ListSubmapsResponse list = Submaps();
    for (const v1::Submap& listed : list.submaps()) {
      const v1::GetSubmapResponse one = server->Call(&SubmapStub::GetSubmap, listed.name()).value();
      num_boxes += one.submap().has_oriented_box();
      bytes += one.SerializeAsString();
    }
    EXPECT_GT(num_boxes, 2);
    return bytes;
  }
};

TEST_F(RestartAnswers, OfALoadedMapAreTheSameBytes) {
  MapUntilTheChairIsGone();
  Restart();  // from here on distances are rounded as in the store
  MoveTheCrate(0.6);
  const auto before = AllBytes();
  EXPECT_NE(before.at("distances"), before.at("distances with what was left free")) << "so that is looked at, too";
  const v1::QueryPointsResponse points = Points();
  EXPECT_GT(std::count(points.packed().free().begin(), points.packed().free().end(), true), 500);
  EXPECT_GT(std::count(points.packed().near_surface().begin(), points.packed().near_surface().end(), true), 500);
  EXPECT_EQ(ListedOfClass(*server, "room", kChairClass).presence(), v1::Submap::ABSENT);
  Restart();
  const auto after = AllBytes();
  for (const auto& [query, bytes] : before) EXPECT_TRUE(after.at(query) == bytes) << query;
}

TEST_F(RestartAnswers, AreTheSameBytesAtAnyMemoryBudget) {
  MapUntilTheChairIsGone();
  Restart();
  MoveTheCrate(0.6);
  const auto whole = AllBytes();
  const auto whole_vertices_m = MeshVerticesOf(*server, "maps/room");
  for (const std::int64_t bytes : {std::int64_t{1} << 40, std::int64_t{1} << 20, std::int64_t{1}}) {
    SCOPED_TRACE(std::to_string(bytes) + " bytes");
    page_bytes = bytes;
    Restart();
    const std::uint64_t before = CountPages().num_reads;
    for (int round = 0; round < 2; ++round) {
      const auto paged = AllBytes();
      for (const auto& [query, answer] : whole) EXPECT_TRUE(paged.at(query) == answer) << query;
      EXPECT_EQ(MeshVerticesOf(*server, "maps/room"), whole_vertices_m);
    }
    EXPECT_GT(CountPages().num_reads, before);
  }
  EXPECT_TRUE(Eventually([] { return CountPages().num_evicted > 0; })) << "of a budget of nothing";
}

TEST_F(RestartAnswers, ThatNeedTooMuchMemoryAreRefusedAndOtherCallsContinue) {
  MapUntilTheChairIsGone();
  page_bytes = std::int64_t{1} << 20;
  Restart();
  SetPageReaderLimit({.bytes = 1, .wait_s = 0.01});  // one tile, then no other
  v1::QueryPointsRequest request;
  request.set_map("maps/room");
  request.set_packed(true);
  ForEachPlace(0.3, [&](double x, double y, double z) {
    for (const double value : {x, y, z}) request.add_packed_points_m(static_cast<float>(value));
  });
  const auto refused = server->Call(&QueryStub::QueryPoints, request);
  EXPECT_EQ(refused.code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << refused.status().error_message();
  EXPECT_EQ(refused.reason(), "OVER_MEMORY_BUDGET");
  EXPECT_EQ(server->Call(&SubmapStub::GetSubmapMesh, "maps/room").code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_TRUE(Eventually([] { return PageReaderBytes() == 0; })) << "what was refused holds nothing";
  Walk(*server, "room", WalkedRoom(false, true), 26, 28);  // frames are not refused when requests use up their memory
  SetPageReaderLimit({});
  EXPECT_OK(server->Call(&QueryStub::QueryPoints, request));
}

/// Number of different items of two lists of equal length.
template <typename List, typename Differ>
int NumDiffering(const List& a, const List& b, const Differ& differ) {
  EXPECT_EQ(a.size(), b.size());
  int count = 0;
  for (int i = 0; i < std::min(a.size(), b.size()); ++i) count += differ(a[i], b[i]) ? 1 : 0;
  return count;
}
template <typename List>
int NumDiffering(const List& a, const List& b) {
  return NumDiffering(a, b, [](const auto& x, const auto& y) { return x != y; });
}

TEST_F(RestartAnswers, OfANewMapDifferFromTheStoredOnesByRoundingOnly) {
  MapUntilTheChairIsGone();
  MoveTheCrate(0.6);
  const v1::ListSubmapsResponse submaps = Submaps();
  const v1::PackedPointResults points = Points().packed();
  const v1::PackedDistanceResults distances = Distances(v1::Vacated::FREE).packed();
  const v1::PackedRayResults rays = Rays().packed();
  const v1::PackedCollisionResults collisions = Collisions().packed();
  const v1::QueryOccupancySliceResponse slice = Slice();
  const v1::QueryRelationsResponse relations = Relations();
  Restart();
  EXPECT_EQ(Submaps().SerializeAsString(), submaps.SerializeAsString()) << "with what is absent, and since when";
  const v1::PackedPointResults points_after = Points().packed();
  EXPECT_EQ(NumDiffering(points_after.free(), points.free()), 0);
  EXPECT_EQ(NumDiffering(points_after.near_surface(), points.near_surface()), 0) << "contradicted voxels are not";
  EXPECT_LE(NumDiffering(points_after.instance_id(), points.instance_id()), 2) << "where votes are as many";
  EXPECT_LE(NumDiffering(points_after.class_id(), points.class_id()), 2);
  const auto is_off = [](double tolerance_m) {
    return [=](float a, float b) { return std::isnan(a) != std::isnan(b) || std::abs(a - b) > tolerance_m; };
  };
  EXPECT_LE(NumDiffering(points_after.tsdf_m(), points.tsdf_m(), is_off(0.08 / 4096 + 1e-7)), 2);
  // Rounding may decide between equally near surfaces, and whether a ray hits an edge.
  const auto allowed = [](int size) { return size / 200; };
  const v1::PackedDistanceResults distances_after = Distances(v1::Vacated::FREE).packed();
  const int num_distances = distances.status_size();
  EXPECT_LE(NumDiffering(distances_after.status(), distances.status()), allowed(num_distances));
  EXPECT_LE(NumDiffering(distances_after.instance_id(), distances.instance_id()), allowed(num_distances));
  EXPECT_LE(NumDiffering(distances_after.distance_m(), distances.distance_m(), is_off(1e-3)), allowed(num_distances));
  const v1::PackedRayResults rays_after = Rays().packed();
  EXPECT_LE(NumDiffering(rays_after.instance_id(), rays.instance_id()), 3);
  EXPECT_LE(NumDiffering(rays_after.free_distance_m(), rays.free_distance_m(), is_off(1e-3)), 3);
  const v1::PackedCollisionResults collisions_after = Collisions().packed();
  EXPECT_LE(NumDiffering(collisions_after.colliding(), collisions.colliding()), allowed(collisions.colliding_size()));
  EXPECT_LE(NumDiffering(collisions_after.status(), collisions.status()), allowed(collisions.status_size()));
  const v1::QueryOccupancySliceResponse slice_after = Slice();
  ASSERT_EQ(slice_after.cells().size(), slice.cells().size());
  int num_cells = 0;
  for (std::size_t i = 0; i < slice.cells().size(); ++i) num_cells += slice.cells()[i] != slice_after.cells()[i];
  // Rounding may move a triangle at a cell's border into the next cell.
  EXPECT_LE(num_cells, 2 * allowed(static_cast<int>(slice.cells().size())));
  ASSERT_EQ(Relations().relations_size(), relations.relations_size());
}

TEST_F(RestartAnswers, GoneCountsFromBeforeARestartCountAfterIt) {
  const auto whole_store = MakeMemoryStore();
  TestServer whole(*whole_store);
  CreateWalkedMap(whole, "room");
  CreateWalkedMap(*server, "room");
  Walk(whole, "room", WalkedRoom(true), 0, 12);
  Walk(*server, "room", WalkedRoom(true), 0, 12);
  // A single view contradicts nothing, even if it counts twice.
  Walk(*server, "room", WalkedRoom(false), 12, 13);
  EXPECT_EQ(ListedOfClass(*server, "room", kChairClass).last_contradicted_stamp_ns(), 0);
  Restart();
  Walk(*server, "room", WalkedRoom(false), 13, 26);
  Walk(whole, "room", WalkedRoom(false), 12, 26);
  const v1::Submap chair = ListedOfClass(*server, "room", kChairClass);
  const v1::Submap expected = ListedOfClass(whole, "room", kChairClass);
  EXPECT_EQ(expected.presence(), v1::Submap::ABSENT);
  EXPECT_EQ(chair.presence(), v1::Submap::ABSENT);
  EXPECT_EQ(chair.name(), expected.name());
  EXPECT_EQ(chair.first_observed_stamp_ns(), expected.first_observed_stamp_ns());
  EXPECT_EQ(chair.last_observed_stamp_ns(), expected.last_observed_stamp_ns());
  EXPECT_GE(chair.last_contradicted_stamp_ns(), WalkStamp_ns(13));
  EXPECT_EQ(chair.num_blocks(), expected.num_blocks());
  const auto num_near_chair = [](TestServer& of) {
    const auto vertices_m = MeshVerticesOf(of, "maps/room");
    return std::count_if(vertices_m.begin(), vertices_m.end(), [](const Eigen::Vector3f& p) {
      return p.z() > 0.16f && (p.cast<double>() - kChairMiddle_m).cwiseAbs().maxCoeff() < 0.45;
    });
  };
  EXPECT_LE(num_near_chair(*server), num_near_chair(whole) + 20);
}

}  // namespace
}  // namespace dhpmap::testing
