// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dhpmap::simulator {
namespace {

struct Waypoint {
  double x_m, y_m, z_m;
  double look_x_m, look_y_m, look_z_m;
};

constexpr double kPi = std::numbers::pi;
constexpr double kTurnCost_m = 0.5;  ///< a turn by 1 rad takes as long as this distance

constexpr std::array<Waypoint, 38> kWaypoints{{
    // Living room: from the kitchen, past the television, behind the sofa.
    {5.70, 2.15, 1.40, 2.90, 2.30, 1.20},
    {4.90, 1.60, 1.40, 2.60, 2.60, 0.80},
    {4.00, 1.05, 1.38, 2.30, 2.90, 0.50},
    {3.10, 0.95, 1.36, 2.00, 2.60, 0.50},
    {2.20, 0.95, 1.36, 0.60, 2.20, 0.60},
    {1.62, 1.20, 1.38, 0.40, 2.90, 0.80},
    {1.45, 2.10, 1.40, 3.60, 2.40, 0.40},
    {1.15, 2.95, 1.42, 2.50, 0.70, 0.70},
    {1.30, 3.72, 1.42, 2.60, 1.20, 0.70},
    {2.20, 3.85, 1.42, 3.70, 2.40, 0.50},
    {3.00, 3.88, 1.40, 5.20, 4.10, 0.90},
    {3.85, 3.70, 1.40, 5.25, 4.40, 0.80},
    {3.75, 4.10, 1.40, 4.60, 5.20, 1.00},
    // Bedroom: around the foot of the bed.
    {3.42, 4.62, 1.40, 2.90, 6.60, 1.20},
    {3.10, 5.40, 1.40, 1.40, 6.60, 0.60},
    {2.65, 6.10, 1.40, 0.80, 7.10, 0.60},
    {2.62, 6.75, 1.40, 0.50, 6.00, 0.60},
    {2.90, 6.80, 1.40, 1.00, 5.00, 0.80},
    {3.08, 6.20, 1.40, 2.60, 4.60, 0.90},
    {3.40, 5.76, 1.40, 4.80, 5.75, 1.35},
    // Bath
    {4.20, 5.75, 1.40, 5.60, 7.20, 0.60},
    {4.90, 6.05, 1.40, 5.60, 7.40, 0.50},
    {5.45, 6.30, 1.40, 4.60, 7.00, 0.70},
    {5.95, 6.05, 1.40, 5.00, 5.00, 0.60},
    {6.40, 5.78, 1.40, 8.20, 6.10, 1.25},
    // Study
    {7.10, 5.80, 1.40, 8.80, 6.90, 0.90},
    {7.90, 6.30, 1.42, 8.80, 7.60, 0.80},
    {8.55, 6.45, 1.42, 9.60, 7.40, 0.70},
    {9.20, 6.10, 1.40, 10.60, 6.00, 0.60},
    {9.25, 5.60, 1.40, 9.80, 4.60, 0.30},
    {8.60, 5.55, 1.40, 7.40, 6.70, 0.70},
    {8.00, 5.20, 1.40, 7.90, 3.90, 0.80},
    // Kitchen: to the counter, along it and back.
    {7.90, 4.30, 1.40, 8.90, 2.60, 1.20},
    {7.75, 3.20, 1.40, 9.40, 2.90, 0.70},
    {8.10, 2.00, 1.40, 9.40, 0.40, 0.90},
    {8.95, 1.42, 1.40, 10.30, 0.60, 0.90},
    {8.90, 1.25, 1.40, 8.10, 0.20, 1.00},
    {7.30, 1.55, 1.40, 6.20, 0.80, 0.90},
}};

double Unwrapped(double angle, double near) { return angle + 2 * kPi * std::round((near - angle) / (2 * kPi)); }

}  // namespace

CameraPath::CameraPath() {
  for (std::size_t i = 0; i <= kWaypoints.size(); ++i) {
    const Waypoint& w = kWaypoints[i % kWaypoints.size()];
    const Eigen::Vector3d look(w.look_x_m - w.x_m, w.look_y_m - w.y_m, w.look_z_m - w.z_m);
    double yaw = std::atan2(look.y(), look.x());
    const double pitch = std::atan2(look.z(), std::hypot(look.x(), look.y()));
    if (i > 0) yaw = Unwrapped(yaw, states_.back()[3]);
    State state;
    state << w.x_m, w.y_m, w.z_m, yaw, pitch;
    if (i == 0) {
      times_.push_back(0);
    } else {
      const double way_m = (state - states_.back()).head<3>().norm();
      length_m_ += way_m;
      times_.push_back(times_.back() + std::hypot(way_m, kTurnCost_m * (yaw - states_.back()[3])));
    }
    states_.push_back(state);
  }
}

// Cubic Hermite interpolation of the waypoints, with slopes from finite differences over unequal times.
CameraPath::State CameraPath::StateAt(double time) const {
  const std::size_t last = states_.size() - 1;
  const auto after = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
  const std::size_t i = std::clamp<std::size_t>(static_cast<std::size_t>(after), 1, last) - 1;
  // After one round a full turn may have been added.
  const State round = states_[last] - states_[0];
  const auto slope = [&](std::size_t k) -> State {
    const bool is_end = k == 0 || k == last;
    const State before = is_end ? State(states_[last - 1] - round) : states_[k - 1];
    const State next = is_end ? states_[1] : states_[k + 1];
    const State here = is_end ? states_[0] : states_[k];
    const double h0 = is_end ? times_[last] - times_[last - 1] : times_[k] - times_[k - 1];
    const double h1 = is_end ? times_[1] : times_[k + 1] - times_[k];
    return ((here - before) / h0 * h1 + (next - here) / h1 * h0) / (h0 + h1);
  };
  const double h = times_[i + 1] - times_[i], s = (time - times_[i]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * states_[i] + (s3 - 2 * s2 + s) * h * slope(i) + (3 * s2 - 2 * s3) * states_[i + 1] +
         (s3 - s2) * h * slope(i + 1);
}

Transform CameraPath::PoseAt(double share) const {
  const State state = StateAt(std::clamp(share, 0.0, 1.0) * times_.back());
  const double yaw = state[3], pitch = state[4];
  const Eigen::Vector3d forward(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
  const Eigen::Vector3d right(std::sin(yaw), -std::cos(yaw), 0);
  Transform T_map_camera = Transform::Identity();
  T_map_camera.linear().col(0) = right;
  T_map_camera.linear().col(1) = forward.cross(right);
  T_map_camera.linear().col(2) = forward;
  T_map_camera.translation() = state.head<3>();
  return T_map_camera;
}

Transform CameraPath::PoseOfFrame(int frame, int num_frames) const {
  return PoseAt(static_cast<double>(frame) / std::max(num_frames, 1));
}

}  // namespace dhpmap::simulator
