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

/// Which object an answer means.
struct Ref {
  std::int64_t id = -1;  ///< 0: an unknown object; -1: none, or space that nobody has seen
  std::string class_name;
};

/// An object as it was at one revision; lengths in metres, in the map's frame. A value.
struct Object {
  std::int64_t id = 0;  ///< never reused; 0 holds the geometry of unknown objects
  std::string name;     ///< for people; follows the class until somebody sets it
  Kind kind = Kind::kUnknown;
  std::string class_name;
  std::int32_t class_id = -1;  ///< -1: it has no class
  /// The smallest upright box around its surface, turned about z; none while it has no surface.
  std::optional<OrientedBox> box;
  Pose T_map_object;
  std::vector<std::array<double, 2>> footprint_m;  ///< its convex outline from above, counterclockwise
  std::optional<double> support_height_m;          ///< z of its upper side, where things may stand
  std::optional<Sphere> bounding_sphere;           ///< around its voxels
  double class_confidence = 0;                     ///< share of its observations that said this class
  double instance_confidence = 0;                  ///< share of its observations that are its own
  bool is_present = true;       ///< false: sensors have looked through most of it, so queries leave it out
  bool is_active = false;       ///< takes new observations; false: settled
  bool is_confirmed = false;    ///< seen again after it was new
  bool is_locked = false;       ///< mapping leaves it alone
  std::int64_t num_frames = 0;  ///< that showed it
  std::optional<std::int64_t> first_seen_ns, last_seen_ns;  ///< stamps of the sensor's clock; none: it was never seen
  std::int64_t revision = 0;                                ///< that last changed it
  std::string etag;

  // Of a search with `near_m`: from there to its surface, and where that is. Else NaN.
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  Vector3 nearest_point_m{distance_m, distance_m, distance_m};
  std::optional<Box> bounds;  ///< of a search: around its surface, in the frame that was asked in
};

}  // namespace dhpmap::client
