// SPDX-License-Identifier: BSD-3-Clause
// A long walk through many rooms, with the noise of a depth camera, and another after things were moved and taken away.
#include <gtest/gtest.h>

#include "clients/simulator/apartment_change.h"
#include "clients/simulator/camera_path.h"
#include "clients/simulator/depth_noise.h"
#include "clients/simulator/renderer.h"
#include "tests/unit/mapping/plausibility/mistakes.h"
#include "tests/unit/mapping/plausibility/walked_room.h"

namespace dhpmap {
namespace {

using testing::EmptyMap;
using testing::FuseAndCheck;
using testing::Mistake;
using testing::Tells;
using testing::Told;

constexpr int kFramesOfWalk = 120;
constexpr std::uint64_t kSeed = 11;

class SimulatedApartment : public ::testing::Test {
 protected:
  [[nodiscard]] PanopticFrame FrameIn(const simulator::ApartmentScene& scene, int i) const {
    const PinholeCamera camera = simulator::FlatLayoutCamera(160, 120);
    const simulator::Renderer renderer(scene, simulator::Renderer::Output::kGeometry);
    const auto rendered = renderer.Render(camera, path_.PoseOfFrame(i % kFramesOfWalk, kFramesOfWalk));
    PanopticFrame frame;
    frame.T_map_sensor = rendered.T_map_camera;
    frame.stamp_ns = i * testing::kWalkPeriod_ns;
    frame.camera = DepthCameraData{.camera = camera,
                                   .depth_m = simulator::NoisyDepth(rendered, 1, kSeed, static_cast<std::uint64_t>(i))};
    return frame;
  }

  const simulator::ApartmentScene scene_;
  const simulator::CameraPath path_;
};

TEST_F(SimulatedApartment, NoFrameIsDoubtedNotEvenAfterThingsWereMovedAndTakenAway) {
  const auto changes = simulator::ChooseChanges(scene_, 8, kSeed);
  ASSERT_TRUE(changes.ok());
  const simulator::ApartmentScene changed = simulator::Changed(scene_, *changes);
  MapBuilder builder(EmptyMap(), 1);
  for (int i = 0; i < 2 * kFramesOfWalk; ++i) {
    const FrameCheck check = FuseAndCheck(builder, FrameIn(i < kFramesOfWalk ? scene_ : changed, i));
    EXPECT_TRUE(check.IsPlausible()) << i << ": " << Told(check);
    EXPECT_GT(check.fit->agreeing_fraction.value_or(i == 0 ? 1 : 0), 0.6) << i;
  }
}

TEST_F(SimulatedApartment, EachMistakeIsFoundWithinTenFramesWhereverTheWalkBegins) {
  for (const int start : {0, 25, 50, 75, 100}) {
    for (const Mistake& mistake : testing::MistakesOfDepthCameras()) {
      MapBuilder builder(EmptyMap(), 1);
      bool is_found = false;
      for (int i = start; i < start + 10 && !is_found; ++i) {
        PanopticFrame frame = FrameIn(scene_, i);
        mistake.make(frame);
        const FrameCheck check = FuseAndCheck(builder, frame);
        EXPECT_TRUE(check.IsPlausible() || Tells(check, mistake.fault)) << FaultName(mistake.fault) << Told(check);
        is_found = Tells(check, mistake.fault);
      }
      EXPECT_TRUE(is_found) << FaultName(mistake.fault) << " from frame " << start;
    }
  }
}

}  // namespace
}  // namespace dhpmap
