// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <variant>

// Lengths are metres, angles radians; frames are right-handed, with z up. All are values.

namespace dhpmap::client {

/// A point or a direction.
struct Vector3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// A rigid transform. Called `T_a_b` it takes points of frame b to frame a.
struct Pose {
  Vector3 translation_m;
  std::array<double, 4> rotation_xyzw = {0, 0, 0, 1};  ///< a quaternion; its norm does not matter
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// At a place, turned about z, counterclockwise from above.
inline Pose PoseAt(const Vector3& translation_m, double yaw_rad = 0) {
  return {translation_m, {0, 0, std::sin(yaw_rad / 2), std::cos(yaw_rad / 2)}};
}

struct Sphere {
  Vector3 center_m;
  double radius_m = 0;
};

/// Along the axes of the frame it is in.
struct Box {
  Vector3 min_m, max_m;
};

/// Around the origin of its own frame.
struct OrientedBox {
  Pose T_map_box;
  Vector3 size_m;  ///< from side to side
};

/// All that is within radius_m of the segment from a to b.
struct Capsule {
  Vector3 a_m, b_m;
  double radius_m = 0;
};

using Region = std::variant<Box, Sphere>;
using Body = std::variant<Sphere, OrientedBox, Capsule>;

struct Ray {
  Vector3 origin_m;
  Vector3 direction;  ///< of any length above 1e-6
};

}  // namespace dhpmap::client
