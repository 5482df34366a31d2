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

/// One answer to each thing that was asked, in their order, all of one state of the map.
template <typename T>
struct Answers {
  std::int64_t revision = 0;  ///< of the map
  std::vector<T> results;

  [[nodiscard]] std::size_t size() const { return results.size(); }
  const T& operator[](std::size_t i) const { return results[i]; }
  [[nodiscard]] auto begin() const { return results.begin(); }
  [[nodiscard]] auto end() const { return results.end(); }
};

/// How far a point is from the nearest surface.
struct Distance {
  bool is_known = false;        ///< false: nobody has seen the point; the rest is about what is known
  bool is_clamped = false;      ///< no surface within max_distance_m, which distance_m then is
  double distance_m = 0;        ///< below 0 behind a surface
  Vector3 gradient;             ///< unit; 0 if clamped
  Vector3 nearest_point_m;      ///< on the surface; NaN if clamped
  std::int64_t object_id = -1;  ///< whose surface; 0: an unknown object, -1: clamped
  std::int32_t class_id = -1;   ///< -1: it has no class
};

/// What is at a point. Neither near a surface nor free: nobody has seen it.
struct PointState {
  bool is_near_surface = false;
  bool is_free = false;        ///< sensors have looked through
  std::int64_t object_id = 0;  ///< near a surface: whose; 0: an unknown object
  std::int32_t class_id = -1;  ///< -1: it has no class
  double tsdf_m = 0;           ///< truncated signed distance of its voxel; NaN where none was observed
  double weight = 0;
  std::array<std::uint8_t, 3> rgb{};
  double class_confidence = 0, instance_confidence = 0;
};

/// What a ray meets first.
struct RayHit {
  bool is_hit = false;          ///< it meets a surface within max_distance_m
  bool is_known = false;        ///< false: before that it enters what nobody has seen
  double distance_m = 0;        ///< to the surface; none: max_distance_m
  double free_m = 0;            ///< so far until it meets something or enters the unseen
  Vector3 point_m, normal;      ///< the normal is unit, to the surface's front; none: NaN
  std::int64_t object_id = -1;  ///< -1: nothing is met
  std::int32_t class_id = -1;   ///< -1: it has no class
};

/// Whether a ball touches anything.
struct Collision {
  bool is_colliding = false;
  bool is_known = false;        ///< false: it touches no surface, but is where nobody has seen
  double depth_m = 0;           ///< of the deepest contact
  Vector3 point_m, normal;      ///< touches nothing: point_m is NaN
  std::int64_t object_id = -1;  ///< -1: touches nothing, or in unseen space
  std::int32_t class_id = -1;   ///< -1: it has no class
};

/// Where something touches a surface, or is where nobody has seen.
struct Contact {
  Ref object;
  double depth_m = 0;  ///< so far along the normal until it ends
  Vector3 point_m;     ///< on the surface; in unseen space the middle of a voxel
  Vector3 normal;      ///< out of the surface, unit; in unseen space 0
};

struct BodyCheck {
  bool is_colliding = false;
  bool is_known = false;          ///< false: it touches no surface, but is where nobody has seen
  std::vector<Contact> contacts;  ///< the deepest first
};

/// A place on a path.
struct PathPlace {
  int waypoint = 0;     ///< after this one,
  double fraction = 0;  ///< at this share of the way to the next
  int sphere = -1;      ///< which one of the robot; -1: what it carries
};

struct PathContact {
  PathPlace place;
  std::optional<Ref> attached;  ///< which of what it carries
  Contact contact;
};

/// Where a path is nearest to a surface that the robot must not touch.
struct Clearance {
  double distance_m = 0;  ///< from the robot's surface, padding taken off; below 0: so deep
  PathPlace place;
  Ref object;
  Vector3 point_m;  ///< on the surface
};

/// Whether a robot can go along a path.
struct PathCheck {
  bool ok = false;                     ///< it touches nothing on all its way
  bool is_known = false;               ///< false: before it touches a surface it goes where nobody has seen
  std::vector<PathContact> contacts;   ///< the first; all, if asked for
  std::optional<Clearance> clearance;  ///< if asked for, and there is a surface within max_distance_m
};

/// A rigid robot: spheres in its own frame.
struct Spheres {
  std::vector<Sphere> spheres_m;
  std::vector<ObjectOrClass> may_touch;  ///< by all of it
  std::vector<std::string> links = {};   ///< a name a sphere, for MayTouch::link; or none
};

}  // namespace dhpmap::client
