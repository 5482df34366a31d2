// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/single_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clients/evaluator/baselines/baselines.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

using testing::LookAt;
using testing::Render;
using testing::Scene;
using testing::SmallCamera;
using testing::Solid;

constexpr ClassId kBallClass{1}, kWallClass{2}, kCurtain{3};
constexpr double kSingleVoxel_m = 0.04;

/// A ball before a wall; segments 1 and 2.
Scene BallBeforeWall() {
  return {{{.shape = Solid::Shape::kSphere, .center_m = {1.5, 0, 1}, .size_m = {0.4, 0, 0}, .segment = 1},
           {.shape = Solid::Shape::kHalfSpace, .center_m = {2.5, 0, 0}, .size_m = {-1, 0, 0}, .segment = 2}}};
}

PanopticFrame WallFrameFrom(const Eigen::Vector3d& eye_m, std::optional<ClassId> wall_class) {
  PanopticFrame frame = Render(BallBeforeWall(), SmallCamera(), LookAt(eye_m, {1.5, 0, 1}));
  frame.segments = {{.id = SegmentId(1), .class_id = kBallClass}, {.id = SegmentId(2), .class_id = wall_class}};
  return frame;
}

SystemSetup SingleMapSetup(int num_threads) { return {IndoorConfig(), testing::MakeLabelSet(1, 2), num_threads}; }

using Maker = std::unique_ptr<MappingSystem> (*)(const SystemSetup&);

LabelledSurface MapWith(Maker make, const std::vector<PanopticFrame>& frames, int num_threads = 1) {
  const auto system = make(SingleMapSetup(num_threads));
  for (const PanopticFrame& frame : frames) EXPECT_TRUE(system->Integrate(frame).ok());
  system->Finish();
  EXPECT_EQ(system->times().num_frames, static_cast<std::int64_t>(frames.size()));
  return system->Surface();
}

/// How many vertices of the wall, away from the ball, are of a class.
std::int64_t CountWall(const LabelledSurface& surface, ClassId class_id) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < surface.mesh.vertices_m.size(); ++i) {
    count += surface.mesh.vertices_m[i].x() > 2.3f && surface.mesh.classes[i] == class_id.value;
  }
  return count;
}

class SingleMapTest : public ::testing::TestWithParam<Maker> {};

TEST_P(SingleMapTest, HasClassesButNoInstances) {
  EXPECT_FALSE(GetParam()(SingleMapSetup(1))->has_instances());
  const LabelledSurface surface = MapWith(GetParam(), {WallFrameFrom({0, 0, 1}, kWallClass)});
  ASSERT_GT(surface.mesh.vertices_m.size(), 1000u);
  EXPECT_TRUE(
      std::all_of(surface.mesh.instances.begin(), surface.mesh.instances.end(), [](auto id) { return id == 0; }));
  EXPECT_GT(std::count(surface.mesh.classes.begin(), surface.mesh.classes.end(), kBallClass.value), 100);
  EXPECT_GT(CountWall(surface, kWallClass), 1000);
}

TEST_P(SingleMapTest, SurfaceLiesWithinAVoxelOfTheScene) {
  const LabelledSurface surface =
      MapWith(GetParam(), {WallFrameFrom({0, 0, 1}, kWallClass), WallFrameFrom({0, 0.4, 1.2}, kWallClass),
                           WallFrameFrom({0, -0.4, 0.8}, kWallClass)});
  const Scene scene = BallBeforeWall();
  std::size_t num_near = 0;
  for (const Eigen::Vector3f& p : surface.mesh.vertices_m) {
    num_near += std::abs(scene.Distance(p.cast<double>())) < kSingleVoxel_m;
  }
  // The rest is the rim of the ball, where rays graze it.
  EXPECT_GT(static_cast<double>(num_near), 0.98 * static_cast<double>(surface.mesh.vertices_m.size()));
}

TEST_P(SingleMapTest, TheClassOfMostFramesWinsAndUnknownHasNoSay) {
  const PanopticFrame wall = WallFrameFrom({0, 0, 1}, kWallClass), curtain = WallFrameFrom({0, 0, 1}, kCurtain);
  const PanopticFrame unknown = WallFrameFrom({0, 0, 1}, std::nullopt);
  const LabelledSurface surface = MapWith(GetParam(), {wall, curtain, unknown, unknown, unknown, curtain});
  EXPECT_GT(CountWall(surface, kCurtain), 1000);
  EXPECT_EQ(CountWall(surface, kWallClass), 0);
}

TEST_P(SingleMapTest, SurfaceThatWasNeverLabelledHasClassZero) {
  const LabelledSurface surface = MapWith(GetParam(), {WallFrameFrom({0, 0, 1}, std::nullopt)});
  EXPECT_GT(CountWall(surface, ClassId(0)), 1000);
  EXPECT_EQ(CountWall(surface, kWallClass), 0);
}

TEST_P(SingleMapTest, AnyNumberOfThreadsGivesTheSameBits) {
  const std::vector<PanopticFrame> frames = {WallFrameFrom({0, 0, 1}, kWallClass),
                                             WallFrameFrom({0, 0.3, 1}, kCurtain)};
  const LabelledSurface one = MapWith(GetParam(), frames, 1), two = MapWith(GetParam(), frames, 2);
  EXPECT_EQ(one.mesh.vertices_m, two.mesh.vertices_m);
  EXPECT_EQ(one.mesh.classes, two.mesh.classes);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
}

TEST_P(SingleMapTest, RefusesAFrameThatIsNotValid) {
  PanopticFrame frame = WallFrameFrom({0, 0, 1}, kWallClass);
  frame.segments[0].class_id = ClassId(999);
  const auto system = GetParam()(SingleMapSetup(1));
  EXPECT_EQ(system->Integrate(frame).code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(system->Surface().mesh.vertices_m.empty());
}

INSTANTIATE_TEST_SUITE_P(Baselines, SingleMapTest, ::testing::Values(&MakeKimera, &MakeVotes),
                         [](const auto& param_info) { return param_info.index == 0 ? "Kimera" : "Votes"; });

}  // namespace
}  // namespace dhpmap::evaluator
