// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/earlier_view.h"

#include <gtest/gtest.h>

#include "mapping/plausibility/frame_sample.h"
#include "tests/unit/mapping/plausibility/walked_room.h"

namespace dhpmap {
namespace {

using testing::WalkFrame;
using testing::WalkPose;

std::vector<Eigen::Vector3f> PointsOf(const PanopticFrame& frame) {
  return FrameSample(frame).PointsInRange(SensorClaim::Of(frame), IntegrationConfig());
}

TEST(EarlierView, AgreesWithPointsOfALaterFrameThatItHasSeen) {
  const EarlierView view(WalkFrame(0));
  for (int i = 0; i < 4; ++i) {
    const ViewFit fit = view.FitOf(PointsOf(WalkFrame(i)), WalkPose(i), view.claim());
    EXPECT_EQ(fit.num_before, 0u) << i;
    EXPECT_GE(fit.num_agreeing * 10, fit.num_seen() * 9) << i;
    EXPECT_GE(fit.num_seen() * 10, fit.num_points * (10 - static_cast<std::size_t>(i))) << i;
  }
}

TEST(EarlierView, TellsWhatIsBeforeAndBehindWhatItHasSeen) {
  const PanopticFrame frame = WalkFrame(0);
  const EarlierView view(frame);
  auto points_m = PointsOf(frame);
  for (Eigen::Vector3f& p : points_m) p *= 0.8f;
  const ViewFit before = view.FitOf(points_m, frame.T_map_sensor, view.claim());
  EXPECT_GE(before.num_before * 10, before.num_points * 9);
  EXPECT_EQ(before.num_behind, 0u);
  for (Eigen::Vector3f& p : points_m) p *= 1.2f / 0.8f;
  const ViewFit behind = view.FitOf(points_m, frame.T_map_sensor, view.claim());
  EXPECT_GE(behind.num_behind * 10, behind.num_points * 9);
  EXPECT_EQ(behind.num_before, 0u);
}

TEST(EarlierView, SaysNothingOfWhatIsBesideItsImageOrBehindItsCamera) {
  const PanopticFrame frame = WalkFrame(0);
  const EarlierView view(frame);
  const Transform T_turned = frame.T_map_sensor * Eigen::AngleAxisd(3.1, Eigen::Vector3d::UnitY());
  const ViewFit fit = view.FitOf(PointsOf(frame), T_turned, view.claim());
  EXPECT_GT(fit.num_points, 100u);
  EXPECT_EQ(fit.num_seen(), 0u);
}

TEST(EarlierView, SaysNothingWhereItHasNoReturn) {
  PanopticFrame frame = WalkFrame(0);
  const auto points_m = PointsOf(frame);
  frame.camera->depth_m.assign(frame.camera->depth_m.size(), 0);
  const EarlierView view(frame);
  EXPECT_EQ(view.FitOf(points_m, frame.T_map_sensor, view.claim()).num_seen(), 0u);
}

TEST(EarlierView, ImagesOfAnyShapeAreTaken) {
  for (const auto& [width_px, height_px] : {std::pair{1, 1}, {16384, 1}, {1, 16384}, {159, 161}}) {
    PanopticFrame frame;
    frame.camera = DepthCameraData{
        .camera = {.width_px = width_px, .height_px = height_px, .fx_px = 100, .fy_px = 100, .cx_px = 0, .cy_px = 0}};
    frame.camera->depth_m.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 1);
    const EarlierView view(frame);
    const std::vector<Eigen::Vector3f> points_m{{0, 0, 1}, {50, 50, 1}, {0, 0, -1}, {0, 0, 1e-30f}};
    EXPECT_LE(view.FitOf(points_m, frame.T_map_sensor, view.claim()).num_seen(), 1u);
  }
}

}  // namespace
}  // namespace dhpmap
