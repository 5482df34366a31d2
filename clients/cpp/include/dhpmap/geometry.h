// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <variant>

// Lengths are in metres, angles in radians; frames are right-handed, with z up. All types are values.

namespace dhpmap::client {

/// A point or a direction.
struct Vector3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// A rigid transform: `T_a_b` maps points from frame b to frame a.
struct Pose {
  Vector3 translation_m;
  std::array<double, 4> rotation_xyzw = {0, 0, 0, 1};  ///< a quaternion; need not be normalised
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// A pose with a rotation about z, counterclockwise seen from above.
inline Pose PoseAt(const Vector3& translation_m, double yaw_rad = 0) {
  return {translation_m, {0, 0, std::sin(yaw_rad / 2), std::cos(yaw_rad / 2)}};
}

struct Sphere {
  Vector3 center_m;
  double radius_m = 0;
};

/// Aligned with the axes of its frame.
struct Box {
  Vector3 min_m, max_m;
};

/// Centred at the origin of its own frame.
struct OrientedBox {
  Pose T_map_box;
  Vector3 size_m;  ///< full extents
};

/// All points within radius_m of the segment from a to b.
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
