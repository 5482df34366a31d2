// SPDX-License-Identifier: BSD-3-Clause
// Whether a view sees past a ball, against all pixels that points of the ball fall into.
#include "mapping/space/gone_look.h"

#include <gtest/gtest.h>

#include <random>

#include "mapping/space/camera_view.h"
#include "mapping/space/lidar_view.h"
#include "tests/unit/mapping/space/looked_through_scene.h"

namespace dhpmap {
namespace {

using testing::FurnishedRoom;
using testing::RoomFrame;
using testing::Scan;

/// Nearer than any ball.
constexpr float kNothing = -1e9f;

struct Ball {
  Eigen::Vector3f center;
  float radius;
};

/// Balls about the sensor: in the directions of `frame`, or anywhere.
std::vector<Ball> RandomBalls(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(-90, 90), radius(0.5f, 4.0f);
  std::vector<Ball> balls;
  for (; count > 0; --count) balls.push_back({{along(random), along(random), along(random)}, radius(random)});
  return balls;
}

template <typename View>
std::vector<bool> LookPast(const View& view, const std::vector<Ball>& balls) {
  std::vector<bool> past;
  for (std::size_t begin = 0; begin < balls.size(); begin += kLanes) {
    BallBatch batch;
    const std::size_t count = std::min<std::size_t>(kLanes, balls.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Ball& ball = balls[begin + i];
      batch.x[i] = ball.center.x();
      batch.y[i] = ball.center.y();
      batch.z[i] = ball.center.z();
      batch.radius[i] = ball.radius;
    }
    std::array<bool, kLanes> is_past;
    view.LookPast(batch, is_past);
    past.insert(past.end(), is_past.begin(), is_past.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return past;
}

/// Calls visit(point) for points on the ball and within.
template <typename Visitor>
void ForPointsOf(const Ball& ball, float times, Visitor&& visit) {
  constexpr int kSteps = 12;
  for (int i = 0; i <= kSteps; ++i) {
    const double polar = M_PI * i / kSteps;
    for (int k = 0; k < 2 * kSteps; ++k) {
      const double around = M_PI * k / kSteps;
      const Eigen::Vector3d on(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
      for (const float share : {0.3f, 0.7f, 1.0f}) {
        visit(Eigen::Vector3f(ball.center + times * share * ball.radius * on.cast<float>()));
      }
    }
  }
}

/// Whether all points of the ball, blown up, fall into pixels of which `limit_of` says that they see beyond its far
/// side.
template <typename LimitOf>
bool AllSeeBeyond(const Ball& ball, float times, float far, LimitOf&& limit_of) {
  bool all = true;
  ForPointsOf(ball, times, [&](const Eigen::Vector3f& p) { all = all && limit_of(p) > far; });
  return all;
}

struct BallScore {
  int num_past = 0, num_wrong = 0, num_missed = 0;
};

template <typename LimitOf, typename FarOf>
BallScore CompareBalls(const std::vector<Ball>& balls, const std::vector<bool>& past, LimitOf&& limit_of,
                       FarOf&& far_of) {
  BallScore score;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const float far = far_of(balls[i]);
    score.num_past += past[i];
    score.num_wrong += past[i] && !AllSeeBeyond(balls[i], 0.99f, far, limit_of);
    // Balls lie in boxes of pixels: what is seen past one twice as large is clear of doubt.
    score.num_missed += !past[i] && AllSeeBeyond(balls[i], 2.0f, far + 0.1f, limit_of) &&
                        AllSeeBeyond(balls[i], 1.5f, far + 0.1f, limit_of);
  }
  return score;
}

TEST(GoneLook, ACameraSeesPastABallIfAllPixelsThatItCoversSeeFarther) {
  ThreadPool pool(1);
  for (int i = 0; i < 3; ++i) {
    const PanopticFrame frame = RoomFrame(i, FurnishedRoom());
    const Eigen::Matrix3d R = frame.T_map_sensor.linear().transpose();
    CameraView view;
    view.Build(*frame.camera, R, {0.04, 0.08, 5.0}, pool);
    const PinholeCamera& camera = frame.camera->camera;
    const auto limit_of = [&](const Eigen::Vector3f& p_grid) {
      const Eigen::Vector3d p = R * p_grid.cast<double>();
      if (p.z() <= 0) return kNothing;
      const int u = static_cast<int>(std::floor((camera.fx_px * p.x() / p.z() + camera.cx_px + 0.5) / 2));
      const int v = static_cast<int>(std::floor((camera.fy_px * p.y() / p.z() + camera.cy_px + 0.5) / 2));
      const SightImage& image = view.image();
      if (u < 0 || v < 0 || u >= image.width || v >= image.height) return kNothing;
      return image.limit_vox[static_cast<std::size_t>(v * image.width + u)];
    };
    const auto far_of = [&](const Ball& ball) { return (R.cast<float>() * ball.center).z() + ball.radius; };
    const std::vector<Ball> balls = RandomBalls(4000);
    const BallScore score = CompareBalls(balls, LookPast(view, balls), limit_of, far_of);
    EXPECT_GT(score.num_past, 20);
    EXPECT_EQ(score.num_wrong, 0);
    EXPECT_LE(score.num_missed, score.num_past / 10);
  }
}

TEST(GoneLook, ALidarSeesPastABallIfAllBinsThatItCoversGoFarther) {
  ThreadPool pool(1);
  Transform pose = Transform::Identity();
  pose.translate(Eigen::Vector3d(0.3, 0.1, 1.2)).rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -1, 4).normalized()));
  const PanopticFrame frame = Scan(FurnishedRoom(), pose, 48, -40, 35, 600);
  const Eigen::Matrix3d R = pose.linear().transpose();
  LidarView view;
  view.Build(*frame.lidar, R, {0.04, 0.08, 5.0}, pool);
  const auto limit_of = [&](const Eigen::Vector3f& p_grid) {
    const Eigen::Vector3f p = R.cast<float>() * p_grid;
    const Direction direction = DirectionOf(p.x(), p.y(), p.z());
    const int column = std::clamp(static_cast<int>(direction.azimuth), 0, kAzimuthBins - 1);
    const int u = column - view.window().first_column;
    const int v = static_cast<int>(direction.elevation) - view.window().first_row;
    const SightImage& image = view.image();
    if (u < 0 || u >= image.width || v < 0 || v >= image.height) return kNothing;
    return image.limit_vox[static_cast<std::size_t>(v * image.width + u)];
  };
  const auto far_of = [](const Ball& ball) { return ball.center.norm() + ball.radius; };
  std::vector<Ball> balls = RandomBalls(4000);
  for (int i = 0; i < 200; ++i) {  // where azimuths go around
    const Eigen::Vector3f p =
        R.transpose().cast<float>() * Eigen::Vector3f(-12, 0.01f * static_cast<float>(i - 100), 0);
    balls.push_back({p, 0.5f + 0.005f * static_cast<float>(i)});
  }
  const std::vector<bool> past = LookPast(view, balls);
  const BallScore score = CompareBalls(balls, past, limit_of, far_of);
  EXPECT_GT(score.num_past, 100);
  EXPECT_EQ(score.num_wrong, 0);
  EXPECT_LE(score.num_missed, score.num_past / 10);
  EXPECT_GT(std::count(past.end() - 200, past.end(), true), 100);
}

}  // namespace
}  // namespace dhpmap
