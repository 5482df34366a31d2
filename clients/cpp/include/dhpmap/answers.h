// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/geometry.h"
#include "dhpmap/object.h"

namespace dhpmap::client {

/// One answer for each question, in their order, all from one state of the map.
template <typename T>
struct Answers {
  std::int64_t revision = 0;  ///< of the map
  std::vector<T> results;

  [[nodiscard]] std::size_t size() const { return results.size(); }
  const T& operator[](std::size_t i) const { return results[i]; }
  [[nodiscard]] auto begin() const { return results.begin(); }
  [[nodiscard]] auto end() const { return results.end(); }
};

/// The distance from a point to the nearest surface.
struct Distance {
  bool is_known = false;        ///< false: the point is unobserved; the other fields refer to observed space
  bool is_clamped = false;      ///< no surface within max_distance_m, which is then distance_m
  double distance_m = 0;        ///< below 0 behind a surface
  Vector3 gradient;             ///< unit; 0 if clamped
  Vector3 nearest_point_m;      ///< on the surface; NaN if clamped
  std::int64_t object_id = -1;  ///< object of the surface; 0: an unknown object, -1: clamped
  std::int32_t class_id = -1;   ///< -1: no class
};

/// The state of a point. Neither near a surface nor free means unobserved.
struct PointState {
  bool is_near_surface = false;
  bool is_free = false;        ///< sensors have looked through it
  std::int64_t object_id = 0;  ///< near a surface: its object; 0: an unknown object
  std::int32_t class_id = -1;  ///< -1: no class
  double tsdf_m = 0;           ///< truncated signed distance of its voxel; NaN if unobserved
  double weight = 0;
  std::array<std::uint8_t, 3> rgb{};
  double class_confidence = 0, instance_confidence = 0;
};

/// The first hit of a ray.
struct RayHit {
  bool is_hit = false;          ///< it hits a surface within max_distance_m
  bool is_known = false;        ///< false: it enters unobserved space before
  double distance_m = 0;        ///< to the surface; max_distance_m if none
  double free_m = 0;            ///< length until it hits something or enters unobserved space
  Vector3 point_m, normal;      ///< the normal is unit and points to the surface's front; NaN if none
  std::int64_t object_id = -1;  ///< -1: no hit
  std::int32_t class_id = -1;   ///< -1: no class
};

/// Whether a sphere collides.
struct Collision {
  bool is_colliding = false;
  bool is_known = false;        ///< false: it touches no surface, but is partly in unobserved space
  double depth_m = 0;           ///< of the deepest contact
  Vector3 point_m, normal;      ///< point_m is NaN without a contact
  std::int64_t object_id = -1;  ///< -1: no contact, or in unobserved space
  std::int32_t class_id = -1;   ///< -1: no class
};

/// A contact with a surface or with unobserved space.
struct Contact {
  Ref object;
  double depth_m = 0;  ///< motion along the normal that resolves the contact
  Vector3 point_m;     ///< on the surface; in unobserved space the centre of a voxel
  Vector3 normal;      ///< unit, out of the surface; 0 in unobserved space
};

struct BodyCheck {
  bool is_colliding = false;
  bool is_known = false;          ///< false: it touches no surface, but is partly in unobserved space
  std::vector<Contact> contacts;  ///< the deepest first
};

/// A position on a path.
struct PathPlace {
  int waypoint = 0;     ///< the last waypoint before it
  double fraction = 0;  ///< share of the way from there to the next waypoint
  int sphere = -1;      ///< index of the robot's sphere; -1: an attached object
};

struct PathContact {
  PathPlace place;
  std::optional<Ref> attached;  ///< the attached object, if any
  Contact contact;
};

/// The position at which a path is nearest to a surface that the robot must not touch.
struct Clearance {
  double distance_m = 0;  ///< from the robot's surface, after padding; below 0: penetration
  PathPlace place;
  Ref object;
  Vector3 point_m;  ///< on the surface
};

/// Whether a robot can follow a path.
struct PathCheck {
  bool ok = false;                     ///< no contact on the whole path
  bool is_known = false;               ///< false: it enters unobserved space before it touches a surface
  std::vector<PathContact> contacts;   ///< the first one; all if requested
  std::optional<Clearance> clearance;  ///< if requested, and there is a surface within max_distance_m
};

/// A rigid robot: spheres in its own frame.
struct Spheres {
  std::vector<Sphere> spheres_m;
  std::vector<ObjectOrClass> may_touch;  ///< allowed contacts of the whole robot
  std::vector<std::string> links = {};   ///< a name for each sphere, for MayTouch::link; or empty
};

}  // namespace dhpmap::client
