// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/truth_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

constexpr std::uint32_t kCar = 7, kRoad = 3;

/// A scan at `T_map_sensor` of points of two objects.
PanopticFrame ScanOf(const std::vector<std::pair<Eigen::Vector3f, std::uint32_t>>& points) {
  PanopticFrame frame;
  frame.has_persistent_ids = frame.unlisted_ids_are_unknown = true;
  frame.segments = {{SegmentId(kCar), ClassId(1), 1}, {SegmentId(kRoad), ClassId(2), 1}};
  LidarData& scan = frame.lidar.emplace();
  for (const auto& [p, segment] : points) {
    scan.points_m.push_back(p);
    scan.segments.push_back(segment);
  }
  return frame;
}

TruthPoints Outdoors() {
  IntegrationConfig config;
  config.min_range_m = 1;
  config.max_range_m = 30;
  return TruthPoints(config);
}

TEST(TruthPoints, AreOneACellWithTheLabelAndTheMeanOfMostOfItsPoints) {
  TruthPoints points = Outdoors();
  points.Add(ScanOf({{{5.02f, 0.02f, 0.02f}, kCar},
                     {{5.04f, 0.04f, 0.02f}, kCar},
                     {{5.09f, 0.09f, 0.09f}, kRoad},
                     {{6.05f, 0.05f, 0.05f}, 99},
                     {{8.05f, 0.05f, 0.05f}, kRoad}}));
  const SurfaceSamples elements = points.Elements();
  ASSERT_EQ(elements.size(), 3u);
  EXPECT_LT((elements.positions_m[0] - Eigen::Vector3f(5.03f, 0.03f, 0.02f)).norm(), 1e-5);
  EXPECT_EQ(elements.classes, (std::vector<std::uint16_t>{1, 0, 2}));
  EXPECT_EQ(elements.instances, (std::vector<std::uint32_t>{kCar, 0, kRoad})) << "99 has no class";
}

TEST(TruthPoints, DoNotDependOnTheOrderOfFramesAndPoints) {
  std::vector<std::pair<Eigen::Vector3f, std::uint32_t>> one, other;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f p(3 + 0.013f * static_cast<float>(i % 40), 0.5f * static_cast<float>(i % 3), 0.01f);
    one.emplace_back(p, i % 2 == 0 ? kCar : kRoad);
    other.emplace_back(p, i % 5 == 0 ? kRoad : kCar);
  }
  TruthPoints forth = Outdoors(), back = Outdoors();
  forth.Add(ScanOf(one));
  forth.Add(ScanOf(other));
  std::reverse(one.begin(), one.end());
  back.Add(ScanOf(other));
  back.Add(ScanOf(one));
  const SurfaceSamples a = forth.Elements(), b = back.Elements();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.classes, b.classes);
  EXPECT_EQ(a.instances, b.instances);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a.positions_m[i] - b.positions_m[i]).norm(), 1e-5);
}

TEST(TruthPoints, OfEqualsTakeTheSmallerClass) {
  TruthPoints points = Outdoors();
  points.Add(ScanOf({{{5.02f, 0, 0}, kRoad}, {{5.03f, 0, 0}, kCar}}));
  EXPECT_EQ(points.Elements().classes, std::vector<std::uint16_t>{1});
}

TEST(TruthPoints, OutsideTheRangeThatIsFusedAreLeftOut) {
  TruthPoints points = Outdoors();
  points.Add(ScanOf({{{0.5f, 0, 0}, kCar}, {{31, 0, 0}, kCar}, {{NAN, 0, 0}, kCar}, {{29, 0, 0}, kCar}}));
  EXPECT_EQ(points.Elements().size(), 1u);
}

TEST(TruthPoints, OfADepthImageLieOnTheSceneInTheMapFrame) {
  using dhpmap::testing::Solid;
  const dhpmap::testing::Scene scene{{{Solid::Shape::kHalfSpace, {0, 0, 0}, {0, 0, 1}, 1, {9, 9, 9}},
                                      {Solid::Shape::kSphere, {1.5, 0, 0.4}, {0.4, 0, 0}, 2, {9, 9, 9}}}};
  PanopticFrame frame =
      Render(scene, dhpmap::testing::SmallCamera(), dhpmap::testing::LookAt({-0.4, 0.3, 1.2}, {1.5, 0, 0.3}));
  frame.segments = {{SegmentId(1), ClassId(3), 1}, {SegmentId(2), ClassId(1), 1}};
  frame.camera->depth_m[0] = std::nanf("");
  TruthPoints points{IntegrationConfig{}};
  points.Add(frame);
  const SurfaceSamples elements = points.Elements();
  ASSERT_GT(elements.size(), 1000u);
  int num_balls = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Eigen::Vector3d p = elements.positions_m[i].cast<double>();
    EXPECT_NEAR(scene.Distance(p), 0, TruthPoints::kCameraCell_m / 4) << p.transpose();
    num_balls += elements.classes[i] == 1;
    EXPECT_EQ(elements.classes[i] == 1, elements.instances[i] == 2);
  }
  EXPECT_GT(num_balls, 50);
}

}  // namespace
}  // namespace dhpmap::evaluator
