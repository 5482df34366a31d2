// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "clients/simulator/camera_path.h"
#include "clients/simulator/depth_noise.h"
#include "clients/simulator/instance_views.h"
#include "tests/unit/clients/simulator/recorded_apartment.h"

namespace dhpmap::simulator {
namespace {

using testing::Apartment;

RenderedFrame GeometryAt(double share, int width_px = 64, int height_px = 48) {
  return Renderer(Apartment(), Renderer::Output::kGeometry)
      .Render(FlatLayoutCamera(width_px, height_px), CameraPath().PoseAt(share));
}

TEST(Renderer, DepthIsTheDistanceToTheFirstSolidOnTheRay) {
  for (double share : {0.05, 0.3, 0.5, 0.65, 0.9}) {
    const RenderedFrame frame = GeometryAt(share);
    for (int v = 1; v < 48; v += 5) {
      for (int u = 1; u < 64; u += 5) {
        const Eigen::Vector3d direction = PixelDirection(frame.camera, u, v);
        const Ray ray{frame.T_map_camera.translation(), frame.T_map_camera.linear() * direction};
        // Without the tree: all solids, one after the other.
        double nearest_m = kFar_m;
        std::uint8_t instance = 0;
        for (const Solid& solid : Apartment().solids()) {
          const std::optional<double> t = solid.Intersect(ray, nearest_m);
          if (!t) continue;
          nearest_m = *t;
          instance = solid.instance;
        }
        const auto i = static_cast<std::size_t>(v * 64 + u);
        ASSERT_NEAR(frame.depth_m[i], nearest_m * direction.z(), 1e-4);
        EXPECT_EQ(frame.instances[i], instance);
      }
    }
  }
}

TEST(Renderer, EveryPixelsPointLiesOnTheSurfaceOfItsInstance) {
  for (double share : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    const RenderedFrame frame = GeometryAt(share);
    for (std::size_t i = 0; i < frame.depth_m.size(); i += 7) {
      ASSERT_GT(frame.depth_m[i], 0) << "the apartment is closed";
      const int u = static_cast<int>(i) % 64, v = static_cast<int>(i) / 64;
      const Eigen::Vector3d direction = PixelDirection(frame.camera, u, v);
      const Eigen::Vector3d p = frame.T_map_camera * (frame.depth_m[i] / direction.z() * direction);
      EXPECT_NEAR(Apartment().Distance(p), 0, 1e-4);
      double own_m = std::numeric_limits<double>::infinity();
      for (const Solid& solid : Apartment().solids()) {
        if (solid.instance == frame.instances[i]) own_m = std::min(own_m, std::abs(solid.Distance(p)));
      }
      EXPECT_LT(own_m, 1e-4);
    }
  }
}

TEST(Renderer, PicturesAreNeitherDarkNorBurntOut) {
  const Renderer renderer(Apartment());
  for (double share : {0.05, 0.25, 0.45, 0.65, 0.95}) {
    const RenderedFrame frame = renderer.Render(FlatLayoutCamera(64, 48), CameraPath().PoseAt(share));
    ASSERT_EQ(frame.color.size(), frame.depth_m.size());
    double sum = 0;
    for (const Rgb& color : frame.color) sum += (color.r + color.g + color.b) / 3.0;
    const double mean = sum / static_cast<double>(frame.color.size());
    EXPECT_GT(mean, 70) << share;
    EXPECT_LT(mean, 215) << share;
  }
}

TEST(DepthNoise, HasTheSpreadOfADepthCamera) {
  RenderedFrame wall{.camera = FlatLayoutCamera(160, 120)};
  for (const float z : {0.8f, 2.0f, 4.0f}) {
    wall.depth_m.assign(160 * 120, z);
    const std::vector<float> noisy = NoisyDepth(wall, 1, 1, 0);
    double sum = 0, sum_of_squares = 0;
    int count = 0;
    for (float measured : noisy) {
      if (measured == 0) continue;
      sum += measured - z;
      sum_of_squares += (measured - z) * (measured - z);
      ++count;
    }
    ASSERT_GT(count, 18000);
    EXPECT_NEAR(sum / count, 0, 0.05 * DepthSigma_m(z));
    EXPECT_NEAR(std::sqrt(sum_of_squares / count), DepthSigma_m(z), 0.03 * DepthSigma_m(z));
  }
  EXPECT_DOUBLE_EQ(DepthSigma_m(2.4), 0.0012 + 0.0019 * 4);
  const std::vector<float> once = NoisyDepth(wall, 1, 1, 0), twice = NoisyDepth(wall, 2, 1, 0);
  for (std::size_t i = 0; i < once.size(); ++i) ASSERT_NEAR(twice[i] - 4.0f, 2 * (once[i] - 4.0f), 1e-5);
}

TEST(DepthNoise, DropsWhatIsFarAndMostAtEdges) {
  RenderedFrame step{.camera = FlatLayoutCamera(160, 120)};
  for (int i = 0; i < 160 * 120; ++i) step.depth_m.push_back(i % 160 < 80 ? 2.0f : i % 160 < 120 ? 5.0f : 8.5f);
  const std::vector<float> noisy = NoisyDepth(step, 1, 1, 0);
  int at_edge = 0, elsewhere = 0;
  for (int i = 0; i < 160 * 120; ++i) {
    const int u = i % 160;
    const bool is_measured = noisy[static_cast<std::size_t>(i)] > 0;
    if (u >= 120) {
      EXPECT_FALSE(is_measured);
    }
    if (u == 79 || u == 80) at_edge += is_measured;
    if (u == 40) elsewhere += is_measured;
  }
  EXPECT_LT(at_edge, 240 / 2);
  EXPECT_GT(elsewhere, 115);
}

TEST(InstanceViews, PointIsInTheMiddleOfTheWidestPatch) {
  // A square of 20 pixels in front of a wall; depth 2 m.
  RenderedFrame frame{.camera = FlatLayoutCamera(64, 48)};
  frame.depth_m.assign(64 * 48, 3.0f);
  frame.instances.assign(64 * 48, 1);
  for (int v = 10; v < 30; ++v) {
    for (int u = 40; u < 60; ++u) {
      frame.depth_m[static_cast<std::size_t>(v * 64 + u)] = 2.0f;
      frame.instances[static_cast<std::size_t>(v * 64 + u)] = 2;
    }
  }
  const std::vector<InstanceView> views = ViewsOfInstances(frame, 4);
  EXPECT_EQ(views[2].num_pixels, 400);
  EXPECT_EQ(views[2].margin_px, 10);
  EXPECT_EQ(views[2].num_frames, 1);
  EXPECT_NEAR(views[2].point_m.x(), (49.5 - 32) * 2 / 32, 1.1 * 2 / 32);
  EXPECT_NEAR(views[2].point_m.y(), (19.5 - 24) * 2 / 32, 1.1 * 2 / 32);
  EXPECT_NEAR(views[2].point_m.z(), 2, 1e-6);
  EXPECT_EQ(views[3].num_frames, 0);
  EXPECT_EQ(views[3].margin_px, 0);
}

}  // namespace
}  // namespace dhpmap::simulator
