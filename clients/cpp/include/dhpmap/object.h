// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dhpmap/geometry.h"

namespace dhpmap::client {

/// An object by its id, or all objects of a class by its name: {.ignore = {sofa.id, "curtain"}}.
using ObjectOrClass = std::variant<std::int64_t, std::string>;

/// Whether an object is countable (a thing), or the background of one class (stuff).
enum class Kind { kUnknown, kThing, kStuff };

/// The object that an answer refers to.
struct Ref {
  std::int64_t id = -1;  ///< 0: an unknown object; -1: none, or unobserved space
  std::string class_name;
};

/// An object at one revision; lengths in metres, in the map frame. A value.
struct Object {
  std::int64_t id = 0;  ///< never reused; 0 holds the geometry of unknown objects
  std::string name;     ///< display name; follows the class until it is set
  Kind kind = Kind::kUnknown;
  std::string class_name;
  std::int32_t class_id = -1;  ///< -1: no class
  /// The smallest upright box around its surface, rotated about z; none without a surface.
  std::optional<OrientedBox> box;
  Pose T_map_object;
  std::vector<std::array<double, 2>> footprint_m;  ///< its convex outline from above, counterclockwise
  std::optional<double> support_height_m;          ///< z of its upper side, where things may stand
  std::optional<Sphere> bounding_sphere;           ///< around its voxels
  double class_confidence = 0;                     ///< share of its observations with this class
  double instance_confidence = 0;                  ///< share of its observations that are its own
  bool is_present = true;       ///< false: absent, because sensors looked through most of it; queries leave it out
  bool is_active = false;       ///< receives new observations; false: inactive
  bool is_confirmed = false;    ///< seen again after its creation
  bool is_locked = false;       ///< mapping does not change it
  std::int64_t num_frames = 0;  ///< frames that observed it
  std::optional<std::int64_t> first_seen_ns, last_seen_ns;  ///< by the sensor's clock; none: never seen
  std::int64_t revision = 0;                                ///< of its last change
  std::string etag;

  // In a search with `near_m`: the distance to its surface, and the nearest point. Else NaN.
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  Vector3 nearest_point_m{distance_m, distance_m, distance_m};
  std::optional<Box> bounds;  ///< in a search: around its surface, in the frame of the query
};

}  // namespace dhpmap::client
