// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/app/queries/body_check.h"
#include "server/app/queries/distance_grid.h"
#include "server/app/queries/distance_lookup.h"
#include "server/app/queries/mesh_export.h"
#include "server/app/queries/object_queries.h"
#include "server/app/queries/point_query.h"
#include "server/app/queries/ray_cast.h"
#include "server/app/queries/slice_export.h"
#include "server/app/queries/trajectory_check.h"
#include "server/app/queries/voxel_walk.h"
#include "tests/unit/mapping/query/stopped_work.h"

// Bulk work ends soon after its caller cancels it.

namespace dhpmap {
namespace {

constexpr std::size_t kRoomForAll = std::size_t{1} << 30;
constexpr int kThingsAlongX = 8, kThingsAlongY = 4, kThingBlocks = 8;
constexpr int kNumThings = kThingsAlongX * kThingsAlongY;

/// 32 objects of 65,536 voxels each, side by side, made once for all tests.
const std::shared_ptr<const MapView>& SheetView() {
  static const auto view =
      std::make_shared<const MapView>(testing::SheetMap(kThingsAlongX, kThingsAlongY, kThingBlocks));
  return view;
}

/// Points spread evenly over the sheet, at one height.
std::vector<Eigen::Vector3d> PointsOverTheSheet(int num_x, int num_y, double z_m) {
  const double width_m = kThingsAlongX * kThingBlocks * testing::kBlock_m;
  const double depth_m = kThingsAlongY * kThingBlocks * testing::kBlock_m;
  std::vector<Eigen::Vector3d> points_m;
  points_m.reserve(static_cast<std::size_t>(num_x) * static_cast<std::size_t>(num_y));
  for (int y = 0; y < num_y; ++y) {
    for (int x = 0; x < num_x; ++x) {
      points_m.emplace_back((x + 0.5) / num_x * width_m, (y + 0.5) / num_y * depth_m, z_m);
    }
  }
  return points_m;
}

bool HasGivenUp(const Status& status) {
  EXPECT_TRUE(status.ok() || status.code() == StatusCode::kCancelled) << status.ToString();
  return !status.ok();
}

/// Runs pieces in place, counts them, and cancels after a number of them.
Spread HangingUpAfter(std::size_t num_pieces, std::stop_source& caller, std::size_t& num_run) {
  return [&caller, &num_run, num_pieces](std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < count; ++i) {
      if (num_run == num_pieces) caller.request_stop();
      body(i);
      ++num_run;
    }
  };
}

TEST(StoppedPointLookUp, AnswersNothingOfTheRunningBatch) {
  const auto points_m = PointsOverTheSheet(400, 200, 0);
  std::stop_source caller;
  std::size_t num_run = 0;
  int num_answered = 0;
  const Status status = LookUpPoints(*SheetView(), points_m, caller.get_token(), HangingUpAfter(3, caller, num_run),
                                     [&](const PointInfo&) { ++num_answered; });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_EQ(num_answered, 0);
  EXPECT_LE(num_run, 8u) << "pieces of one batch, of the 80 of all";
}

TEST(StoppedPointLookUpClock, EndsSoon) {
  const auto points_m = PointsOverTheSheet(1000, 500, 0.05);
  testing::ExpectEndsSoonAfterAStop([&](const std::stop_token& stop) {
    return HasGivenUp(LookUpPoints(*SheetView(), points_m, stop, InPlace, [](const PointInfo&) {}));
  });
}

TEST(StoppedDistanceLookUp, MakesNoFurtherSurfacesAndAnswersNothingOfTheRunningBatch) {
  const auto points_m = PointsOverTheSheet(128, 64, 0);  // a batch, which goes from one end of the map to the other
  SurfaceCache all(kRoomForAll), part(kRoomForAll);
  ASSERT_TRUE(LookUpDistances(*SheetView(), all, {}, points_m, {}, InPlace, [](const SurfaceDistance&) {}).ok());
  std::stop_source caller;
  std::size_t num_run = 0;
  int num_answered = 0;
  const Status status =
      LookUpDistances(*SheetView(), part, {}, points_m, caller.get_token(), HangingUpAfter(1, caller, num_run),
                      [&](const SurfaceDistance&) { ++num_answered; });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_EQ(num_answered, 0);
  EXPECT_GT(part.bytes(), 0u);
  EXPECT_LT(part.bytes(), all.bytes() / 2) << "of one of eight pieces, and what is around it";
}

TEST(StoppedDistanceGrid, EndsAfterTheRunningBatch) {
  GridQuestion question{.corner_m = {0.05, 0.05, 0}, .resolution_m = 0.1};
  question.size = {250, 120, 2};
  SurfaceCache cache(kRoomForAll);
  DistanceGrid grid(SheetView(), cache, question);
  std::stop_source caller;
  std::int64_t num_nodes = 0;
  for (int i = 0; i < 3; ++i) {
    const auto batch = grid.NextBatch(caller.get_token());
    ASSERT_TRUE(batch.ok());
    EXPECT_LE(batch->size(), DistanceGrid::kMostInBatch) << "which takes about a millisecond";
    num_nodes += static_cast<std::int64_t>(batch->size());
  }
  caller.request_stop();
  EXPECT_EQ(grid.NextBatch(caller.get_token()).status().code(), StatusCode::kCancelled);
  EXPECT_EQ(grid.next(), num_nodes) << "of a batch that was stopped nothing is left out";
  EXPECT_LT(4 * num_nodes, question.num_nodes());
}

TEST(StoppedCastRays, EndsAfterTheRunningRay) {
  SurfaceCache cache(kRoomForAll);
  std::vector<Ray> rays;
  const auto points_m = PointsOverTheSheet(100, 50, 0.3);
  rays.reserve(points_m.size());
  for (const Eigen::Vector3d& p : points_m) rays.push_back({p, -Eigen::Vector3d::UnitZ()});
  std::stop_source caller;
  int num_answered = 0;
  const Status status = CastRays(*SheetView(), cache, {}, rays, caller.get_token(), [&](const RayHit&) {
    if (++num_answered == 100) caller.request_stop();
  });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_EQ(num_answered, 100);
}

TEST(StoppedCheckBodiesClock, EndsSoon) {
  SurfaceCache cache(kRoomForAll);
  const auto points_m = PointsOverTheSheet(60, 30, 0.1);
  std::vector<Body> bodies;
  bodies.reserve(points_m.size());
  for (const Eigen::Vector3d& p : points_m) {
    bodies.emplace_back(OrientedBox{Transform(Eigen::Translation3d(p)), {0.6, 0.6, 0.2}});
  }
  const auto check = [&](const std::stop_token& stop) {
    return HasGivenUp(CheckBodies(*SheetView(), cache, {}, bodies, stop,
                                  [](const BodyAnswer& answer) { EXPECT_TRUE(answer.is_colliding); }));
  };
  EXPECT_FALSE(check({}));  // and the surfaces are there from now on
  testing::ExpectEndsSoonAfterAStop(check);
}

TEST(StoppedCheckTrajectories, AnswersOnlyCheckedOnesAndRequestsNoMore) {
  SurfaceCache cache(kRoomForAll);
  const auto starts_m = PointsOverTheSheet(20, 10, 0.3);
  std::stop_source caller;
  std::size_t num_asked = 0;
  int num_answered = 0;
  const auto motion_of = [&](std::size_t number) {
    if (++num_asked == 4) caller.request_stop();
    RobotMotion motion;
    motion.spheres.push_back(
        std::vector<SphereKnot>{{0, starts_m[number], 0.05}, {1, starts_m[number] - Eigen::Vector3d(0, 0, 0.5), 0.05}});
    return motion;
  };
  const Status status = CheckTrajectories(*SheetView(), cache, {}, starts_m.size(), motion_of, caller.get_token(),
                                          [&](const TrajectoryAnswer& answer) {
                                            EXPECT_FALSE(answer.is_valid);
                                            ++num_answered;
                                          });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_EQ(num_answered, 3);
  EXPECT_EQ(num_asked, 4u);
}

TEST(StoppedFindSubmapsClock, EndsSoonBetweenTheObjects) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    SurfaceCache cache(kRoomForAll);
    const auto matches = FindSubmaps(*SheetView(), cache, {}, stop);
    if (matches.ok()) {
      EXPECT_EQ(matches->size(), static_cast<std::size_t>(kNumThings));
    }
    return HasGivenUp(matches.status());
  });
}

TEST(StoppedFindSubmapsClock, EndsSoonBetweenTheNearest) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    SurfaceCache cache(kRoomForAll);
    return HasGivenUp(FindSubmaps(*SheetView(), cache, {.near_m = Eigen::Vector3d(3, 3, 0.3)}, stop).status());
  });
}

TEST(StoppedListRelationsClock, EndsSoonBetweenTheObjects) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    SurfaceCache cache(kRoomForAll);
    return HasGivenUp(ListRelations(*SheetView(), cache, {}, stop).status());
  });
}

TEST(StoppedExportSliceClock, EndsSoonBetweenTheRows) {
  SurfaceCache cache(kRoomForAll);
  SliceRequest request;
  request.options.min_z_m = -0.4;
  request.options.max_z_m = 0.4;
  request.options.resolution_m = 0.025;
  request.options.with_objects = true;  // else a cell ends with the first voxel that is occupied
  testing::ExpectEndsSoonAfterAStop([&](const std::stop_token& stop) {
    return HasGivenUp(ExportSlice(*SheetView(), cache, request, stop).status());
  });
}

TEST(StoppedExportSliceClock, EndsSoonWithinACell) {
  SurfaceCache cache(kRoomForAll);
  SliceRequest request;
  request.options.min_z_m = -0.4;
  request.options.max_z_m = 0.4;
  request.options.resolution_m = 50;
  request.options.with_objects = true;
  request.area_m.emplace(Eigen::Vector2d(0, 0), Eigen::Vector2d(50, 50));
  testing::ExpectEndsSoonAfterAStop([&](const std::stop_token& stop) {
    return HasGivenUp(ExportSlice(*SheetView(), cache, request, stop).status());
  });
}

TEST(StoppedExportMeshClock, EndsSoonWhileItCounts) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    return HasGivenUp(ExportMesh(SheetView()->shared_snapshot(), {}, stop).status());
  });
}

TEST(StoppedExportMesh, EndsBetweenPiecesOfBoundedSize) {
  auto file = ExportMesh(SheetView()->shared_snapshot(), {});
  ASSERT_TRUE(file.ok());
  constexpr std::size_t kMostInPiece = 200'000;
  std::size_t num_bytes = 0, num_pieces = 0;
  for (std::string piece; file->Next(piece); ++num_pieces) {
    EXPECT_GE(piece.size(), 1u);
    EXPECT_LE(piece.size(), kMostInPiece);
    num_bytes += piece.size();
  }
  EXPECT_EQ(num_bytes, file->num_bytes());
  EXPECT_GT(num_pieces, 40u) << "each of some percent of the whole, at most";
}

TEST(StoppedVoxelWalk, EndsBetweenBlocks) {
  auto walk = VoxelWalk::Begin(SheetView()->shared_snapshot(), SubmapId(1), 0);
  ASSERT_TRUE(walk.ok());
  int num_calls = 0;
  for (; !walk->is_done(); ++num_calls) EXPECT_EQ(walk->NextBlock().size(), static_cast<std::size_t>(kBlockVoxels));
  EXPECT_EQ(num_calls, kThingBlocks * kThingBlocks * 2);
}

}  // namespace
}  // namespace dhpmap
