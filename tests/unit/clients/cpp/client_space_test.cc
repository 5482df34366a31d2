// SPDX-License-Identifier: BSD-3-Clause
// Slices, grids and relations of the C++ client, from a real server.
#include <algorithm>
#include <utility>

#include "tests/unit/clients/cpp/client_room.h"

namespace dhpmap::testing {
namespace {

using client::Relation;
using client::Slice;
using client::Vector3;

using ClientSpace = ClientRoom;

TEST_F(ClientSpace, ASliceIsOccupiedWhereSurfacesAreAndSaysWhereItsCellsAre) {
  const client::Object box = ObjectOf(2);
  ASSERT_TRUE(box.box);
  const Vector3 middle = box.box->T_map_box.translation_m;
  const client::Box area{{middle.x - 1, middle.y - 1, 0}, {middle.x + 1, middle.y + 1, 0}};
  constexpr double kSide_m = 0.1;
  ASSERT_OK_AND_ASSIGN(
      const Slice slice,
      room.Slice({.min_z_m = middle.z - 0.05, .max_z_m = middle.z + 0.05, .area = area, .resolution_m = kSide_m}));
  ASSERT_EQ(slice.cells.size(), static_cast<std::size_t>(slice.width) * static_cast<std::size_t>(slice.height));
  EXPECT_EQ(slice.resolution_m, kSide_m);
  EXPECT_LE(slice.origin_m.x, area.min_m.x);
  EXPECT_NEAR(slice.origin_m.z, middle.z - 0.05, 1e-9);
  std::vector<Vector3> centers_m;
  for (int row = 0; row < slice.height; ++row) {
    for (int column = 0; column < slice.width; ++column) {
      EXPECT_EQ(slice.at(column, row), slice.cells[centers_m.size()]);
      centers_m.push_back(
          Vector3{slice.origin_m.x + (column + 0.5) * kSide_m, slice.origin_m.y + (row + 0.5) * kSide_m, middle.z});
    }
  }
  ASSERT_OK_AND_ASSIGN(const auto distances, room.Distances(centers_m, {.unknown = client::Unknown::kFree}));
  int num_occupied = 0, num_free = 0;
  for (std::size_t i = 0; i < centers_m.size(); ++i) {
    const double distance_m = distances[i].distance_m;
    EXPECT_TRUE(slice.cells[i] != Slice::kOccupied || distance_m < 0.2) << i << ": " << distance_m;
    EXPECT_TRUE(slice.cells[i] != Slice::kFree || distance_m > 0) << i << ": " << distance_m;
    num_occupied += slice.cells[i] == Slice::kOccupied;
    num_free += slice.cells[i] == Slice::kFree;
  }
  EXPECT_GT(num_occupied, 3);
  EXPECT_GT(num_free, 3);
}

TEST_F(ClientSpace, AGridHasTheDistancesOfItsNodes) {
  const client::Box box{{-0.487, -0.389, 0.213}, {1.513, 0.811, 1.113}};  // no node lies between two voxels
  ASSERT_OK_AND_ASSIGN(const client::Pinned now, room.Pin());
  ASSERT_OK_AND_ASSIGN(const client::DistanceGrid grid, now.Grid(box, 0.25));
  ASSERT_EQ(grid.distance_m.size(), static_cast<std::size_t>(grid.num_x * grid.num_y * grid.num_z));
  EXPECT_EQ(grid.revision, now.revision());
  EXPECT_EQ(std::tuple(grid.num_x, grid.num_y, grid.num_z), std::tuple(9, 5, 4));
  std::vector<Vector3> points_m;
  for (int k = 0; k < grid.num_z; ++k) {
    for (int j = 0; j < grid.num_y; ++j) {
      for (int i = 0; i < grid.num_x; ++i) {
        EXPECT_EQ(grid.node(i, j, k), points_m.size());
        points_m.push_back(Vector3{box.min_m.x + 0.25 * i, box.min_m.y + 0.25 * j, box.min_m.z + 0.25 * k});
      }
    }
  }
  ASSERT_OK_AND_ASSIGN(const auto one_by_one, now.Distances(points_m));
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    EXPECT_NEAR(grid.distance_m[i], one_by_one[i].distance_m, 1e-5) << i;
    EXPECT_EQ(grid.is_known[i], one_by_one[i].is_known) << i;
  }
}

TEST_F(ClientSpace, AGridIsOfTheRevisionThatIsAskedFor) {
  const client::Box box{{0, 0, 0.2}, {0.5, 0.5, 0.7}};
  ASSERT_OK_AND_ASSIGN(const auto before, room.Grid(box, 0.25));
  ASSERT_OK(room.Edit().Delete(ObjectOf(1).id).Apply());
  ASSERT_OK_AND_ASSIGN(const auto after, room.Grid(box, 0.25));
  EXPECT_NE(after.distance_m, before.distance_m);
  ASSERT_OK_AND_ASSIGN(const auto past, room.At(before.revision).Grid(box, 0.25));
  EXPECT_EQ(past.distance_m, before.distance_m);
  EXPECT_EQ(room.Grid(box, -1).status().code, client::StatusCode::kInvalidArgument);
}

TEST_F(ClientSpace, RelationsSayWhatStandsOnWhatAndPassTheirFilters) {
  const client::Object ball = ObjectOf(1), box = ObjectOf(2);
  ASSERT_OK(room.Edit().Place(ball.id, box.id).Apply());
  ASSERT_OK_AND_ASSIGN(const auto all, room.Relations({.min_support = 0.01}));
  const auto is_it = [&](const Relation& its) {
    return its.kind == Relation::Kind::kOn && its.subject == ball.id && its.object == box.id;
  };
  const auto found = std::find_if(all.begin(), all.end(), is_it);
  ASSERT_NE(found, all.end());
  EXPECT_GT(found->support, 0);
  EXPECT_EQ(found->object_name, box.name);
  ASSERT_OK_AND_ASSIGN(const auto none,
                       room.Relations({.of = ball.id, .kinds = {Relation::Kind::kIn}, .min_support = 0.01}));
  EXPECT_EQ(std::count_if(none.begin(), none.end(), is_it), 0);
  auto loop = room.Loop();
  ASSERT_OK_AND_ASSIGN(const auto on_a_stream, loop.Relations({.min_support = 0.01}));
  EXPECT_EQ(on_a_stream.size(), all.size());
}

}  // namespace
}  // namespace dhpmap::testing
