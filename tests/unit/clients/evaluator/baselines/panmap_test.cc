// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/panmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clients/evaluator/baselines/baselines.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

using testing::LookAt;
using testing::Render;
using testing::Scene;
using testing::SmallCamera;
using testing::Solid;

constexpr ClassId kBox{1}, kBall{2}, kWall{3};

/// A box and a ball that touch, the box standing at a wall; segments 1, 2 and 3.
Scene TouchingThings() {
  return {{{.shape = Solid::Shape::kBox, .center_m = {2, -0.4, 1}, .size_m = {0.4, 0.4, 0.4}, .segment = 1},
           {.shape = Solid::Shape::kSphere, .center_m = {2, 0.4, 1}, .size_m = {0.4, 0, 0}, .segment = 2},
           {.shape = Solid::Shape::kHalfSpace, .center_m = {2.4, 0, 0}, .size_m = {-1, 0, 0}, .segment = 3}}};
}

PanopticFrame FrameFrom(const Eigen::Vector3d& eye_m, ClassId class_of_box = kBox) {
  PanopticFrame frame = Render(TouchingThings(), SmallCamera(), LookAt(eye_m, {2, 0, 1}));
  frame.segments = {{.id = SegmentId(1), .class_id = class_of_box},
                    {.id = SegmentId(2), .class_id = kBall},
                    {.id = SegmentId(3), .class_id = kWall}};
  return frame;
}

PanopticFrame EmptyFrame() {
  PanopticFrame frame = FrameFrom({0, 0, 1});
  std::fill(frame.camera->depth_m.begin(), frame.camera->depth_m.end(), 0.0f);
  return frame;
}

SystemSetup PanmapSetup(int num_threads = 1) {
  SystemSetup setup{IndoorConfig(), testing::MakeLabelSet(2, 1), num_threads};
  setup.config.tracking.min_points_medium = 100;
  return setup;
}

std::vector<const PanmapSubmap*> OfClass(const Panmap& panmap, ClassId class_id) {
  std::vector<const PanmapSubmap*> found;
  for (const auto& submap : panmap.submaps()) {
    if (submap->geometry.info().class_id == class_id) found.push_back(submap.get());
  }
  return found;
}

/// How many voxel positions are observed in more than one submap.
int CountSharedPositions(const Panmap& panmap) {
  std::map<VoxelIndex, int> holders;
  for (const auto& submap : panmap.submaps()) {
    for (const BlockEntry& entry : submap->geometry.blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (entry.tsdf->IsObserved(i)) ++holders[VoxelIn(entry.index, i)];
      }
    }
  }
  return static_cast<int>(
      std::count_if(holders.begin(), holders.end(), [](const auto& position) { return position.second > 1; }));
}

TEST(PanmapTest, SubmapsOverlapByDesign) {
  Panmap panmap(PanmapSetup());
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1})).ok());
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0.1, 1.1})).ok());
  ASSERT_EQ(panmap.submaps().size(), 3u);
  const int num_shared = CountSharedPositions(panmap);
  RecordProperty("positions_in_several_submaps", num_shared);
  EXPECT_GT(num_shared, 1000);
}

TEST(PanmapTest, EachSurfaceIsLabelledWithTheSubmapItBelongsTo) {
  Panmap panmap(PanmapSetup());
  for (const double y : {-0.2, 0.0, 0.2}) ASSERT_TRUE(panmap.Integrate(FrameFrom({0, y, 1})).ok());
  panmap.Finish();
  const LabelledSurface surface = panmap.Surface();
  ASSERT_EQ(surface.instance_scores.size(), 3u);
  const std::map<std::uint32_t, ClassId> class_of_segment = {{1, kBox}, {2, kBall}, {3, kWall}};
  const Scene scene = TouchingThings();
  std::size_t num_right = 0, num_near = 0;
  std::set<std::pair<std::uint16_t, std::uint32_t>> labels;
  for (std::size_t i = 0; i < surface.mesh.vertices_m.size(); ++i) {
    const Eigen::Vector3d p_m = surface.mesh.vertices_m[i].cast<double>();
    num_near += std::abs(scene.Distance(p_m)) < 0.04;
    num_right += class_of_segment.at(scene.Nearest(p_m)->segment).value == surface.mesh.classes[i];
    labels.emplace(surface.mesh.classes[i], surface.mesh.instances[i]);
  }
  const auto num_vertices = static_cast<double>(surface.mesh.vertices_m.size());
  ASSERT_GT(num_vertices, 2000);
  EXPECT_EQ(labels.size(), 3u);  // one instance a class
  EXPECT_GT(static_cast<double>(num_right), 0.97 * num_vertices);
  EXPECT_GT(static_cast<double>(num_near), 0.97 * num_vertices);
}

TEST(PanmapTest, TracksStuffAndThingsByOverlap) {
  Panmap panmap(PanmapSetup());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0.05 * i, 1})).ok());
  ASSERT_EQ(panmap.submaps().size(), 3u);
  for (const auto& submap : panmap.submaps()) EXPECT_EQ(submap->geometry.info().num_frames_observed, 4);
}

TEST(PanmapTest, OneSegmentOfTwoThingsApartMakesTwoSubmapsAsItDoesForOurs) {
  const Scene scene{{{.shape = Solid::Shape::kSphere, .center_m = {2, -0.8, 1}, .size_m = {0.4, 0, 0}, .segment = 1},
                     {.shape = Solid::Shape::kSphere, .center_m = {2, 0.8, 1}, .size_m = {0.4, 0, 0}, .segment = 1}}};
  PanopticFrame frame = Render(scene, SmallCamera(), LookAt({0, 0, 1}, {2, 0, 1}));
  frame.segments = {{.id = SegmentId(1), .class_id = kBall}};
  SystemSetup setup = PanmapSetup();
  setup.config.tracking.split_gap_vox = 3;
  Panmap panmap(setup);
  const auto whole = MakePanmapOfWholeSegments(setup);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(panmap.Integrate(frame).ok());
    ASSERT_TRUE(whole->Integrate(frame).ok());
  }
  ASSERT_EQ(panmap.submaps().size(), 2u);
  for (const auto& submap : panmap.submaps()) EXPECT_EQ(submap->geometry.info().num_frames_observed, 3);
  whole->Finish();
  EXPECT_EQ(whole->Surface().instance_scores.size(), 1u);
  EXPECT_EQ(whole->name(), "panmap_whole_segments");
}

TEST(PanmapTest, ASegmentOfAnotherClassMakesANewSubmap) {
  Panmap panmap(PanmapSetup());
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1})).ok());
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1})).ok());
  ASSERT_EQ(OfClass(panmap, kBox).size(), 1u);
  // The box is taken for a ball: the same place, but no submap of that class there.
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1}, kBall)).ok());
  EXPECT_EQ(OfClass(panmap, kBox).size(), 1u);
  EXPECT_EQ(OfClass(panmap, kBall).size(), 2u);
}

TEST(PanmapTest, ANewSubmapThatIsNotSeenAgainIsDeleted) {
  Panmap panmap(PanmapSetup());
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1})).ok());
  ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1}, kBall)).ok());
  EXPECT_TRUE(OfClass(panmap, kBox).empty());
  EXPECT_EQ(OfClass(panmap, kBall).size(), 2u);
}

TEST(PanmapTest, InactiveSubmapsAreNotMatchedButMergedLater) {
  Panmap panmap(PanmapSetup());
  const int patience = PanmapSettings().deactivate_after_missed;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1})).ok());
  for (int i = 0; i < patience; ++i) {
    EXPECT_TRUE(OfClass(panmap, kBall).at(0)->IsActive());
    ASSERT_TRUE(panmap.Integrate(EmptyFrame()).ok());
  }
  EXPECT_FALSE(OfClass(panmap, kBall).at(0)->IsActive());
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(panmap.Integrate(FrameFrom({0, 0, 1})).ok());
  ASSERT_EQ(OfClass(panmap, kBall).size(), 2u);
  EXPECT_EQ(OfClass(panmap, kBall)[0]->geometry.info().num_frames_observed, 3);
  panmap.Finish();
  EXPECT_EQ(panmap.submaps().size(), 3u);
  EXPECT_EQ(OfClass(panmap, kBall).at(0)->geometry.info().num_frames_observed, 5);
}

TEST(PanmapTest, SegmentsThatAreTooSmallOrUnknownMakeNoSubmap) {
  SystemSetup setup = PanmapSetup();
  setup.config.tracking.min_points_medium = 100000;
  Panmap panmap(setup);
  PanopticFrame frame = FrameFrom({0, 0, 1});
  frame.segments[2].class_id.reset();
  ASSERT_TRUE(panmap.Integrate(frame).ok());
  EXPECT_TRUE(panmap.submaps().empty());
  panmap.Finish();
  EXPECT_TRUE(panmap.Surface().mesh.vertices_m.empty());
}

TEST(PanmapTest, AnyNumberOfThreadsGivesTheSameBits) {
  LabelledSurface surfaces[2];
  for (int i = 0; i < 2; ++i) {
    Panmap panmap(PanmapSetup(i + 1));
    for (const double y : {-0.2, 0.0, 0.2}) ASSERT_TRUE(panmap.Integrate(FrameFrom({0, y, 1})).ok());
    panmap.Finish();
    surfaces[i] = panmap.Surface();
  }
  EXPECT_EQ(surfaces[0].mesh.vertices_m, surfaces[1].mesh.vertices_m);
  EXPECT_EQ(surfaces[0].mesh.instances, surfaces[1].mesh.instances);
  EXPECT_EQ(surfaces[0].mesh.triangles, surfaces[1].mesh.triangles);
  EXPECT_EQ(surfaces[0].instance_scores, surfaces[1].instance_scores);
}

/// A scan of 0.2 x 0.4 degrees from the origin of the map, 1.5 m above the ground, of a ball and the ground.
PanopticFrame Scan(const Scene& scene) {
  constexpr double kDegree = M_PI / 180;
  PanopticFrame frame;
  frame.T_map_sensor.translation() = Eigen::Vector3d(0, 0, 1.5);
  LidarData& scan = frame.lidar.emplace();
  for (double elevation = 2.8; elevation > -24.8; elevation -= 0.4375) {
    for (double azimuth = -40; azimuth < 40; azimuth += 0.2) {
      const Eigen::Vector3d direction(std::cos(azimuth * kDegree) * std::cos(elevation * kDegree),
                                      std::sin(azimuth * kDegree) * std::cos(elevation * kDegree),
                                      std::sin(elevation * kDegree));
      double range_m = 0;
      Eigen::Vector3d p_m = frame.T_map_sensor.translation();
      for (int step = 0; step < 500 && range_m < 25 && scene.Distance(p_m) > 1e-4; ++step) {
        range_m += scene.Distance(p_m);
        p_m = frame.T_map_sensor.translation() + range_m * direction;
      }
      if (range_m >= 25 || scene.Distance(p_m) > 1e-3) continue;
      scan.points_m.push_back((range_m * direction).cast<float>());
      scan.segments.push_back(scene.Nearest(p_m)->segment);
    }
  }
  return frame;
}

TEST(PanmapTest, MapsLidarThroughASphericalImage) {
  const Scene scene = {{{.shape = Solid::Shape::kSphere, .center_m = {8, 0, 1.5}, .size_m = {1.5, 0, 0}, .segment = 1},
                        {.shape = Solid::Shape::kHalfSpace, .center_m = {0, 0, 0}, .size_m = {0, 0, 1}, .segment = 2}}};
  PanopticFrame frame = Scan(scene);
  frame.segments = {{.id = SegmentId(1), .class_id = kBall}, {.id = SegmentId(2), .class_id = kWall}};
  Panmap panmap({OutdoorLidarConfig(), testing::MakeLabelSet(2, 1), 1});
  ASSERT_TRUE(panmap.Integrate(frame).ok());
  panmap.Finish();
  ASSERT_EQ(panmap.submaps().size(), 2u);
  const LabelledSurface surface = panmap.Surface();
  std::size_t num_ball = 0, num_near = 0;
  for (std::size_t i = 0; i < surface.mesh.vertices_m.size(); ++i) {
    if (surface.mesh.classes[i] != kBall.value) continue;
    ++num_ball;
    num_near += std::abs(scene.solids[0].Distance(surface.mesh.vertices_m[i].cast<double>())) < 0.1;
  }
  ASSERT_GT(num_ball, 300u);
  EXPECT_GT(static_cast<double>(num_near), 0.9 * static_cast<double>(num_ball));
}

}  // namespace
}  // namespace dhpmap::evaluator
