// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/geometry/moving_sphere.h"
#include "mapping/query/attached_shape.h"
#include "mapping/query/clearance_query.h"
#include "mapping/query/sweep_query.h"
#include "mapping/query/touch_lists.h"

namespace dhpmap {

/// An object that the robot carries, and the submaps that it may touch.
struct AttachedObject {
  SubmapId submap;
  std::vector<SubmapId> may_touch;
};

/// A motion in the map frame, with the same number of waypoints for all parts of the robot: spheres at each waypoint,
/// or a rigid robot.
struct RobotMotion {
  std::vector<std::vector<SphereKnot>> spheres;  ///< knots of each sphere
  std::vector<AttachedShape::Ball> robot;        ///< numbered after the spheres
  std::vector<Transform> waypoints;              ///< T_map_robot
  std::vector<std::vector<Transform>>
      attached;  ///< T_map_submap of the attached objects, in their order, at each waypoint
};

struct TrajectoryOptions {
  BodyOptions bodies;  ///< its scope excludes all attached objects
  std::vector<AttachedObject> attached;
  TouchLists spheres{};  ///< allowed contacts of the spheres, and of the robot's
  /// 1: only the first contact. More: the first contact of each part of the robot with each object, earliest first. The
  /// first of a part may be with the inside of an object, the others are with surfaces.
  std::size_t max_contacts = 1;
  bool with_clearance = false;  ///< compute the clearance of each motion
};

/// First contact of a part of the robot with an object.
struct TrajectoryContact {
  double at;                            ///< time, in waypoints
  std::optional<std::size_t> sphere;    ///< index of the sphere, or
  std::optional<std::size_t> attached;  ///< index of the attached object
  BodyContact contact;
  double depth_then_m = 0;  ///< see SweepContact
};

/// The smallest distance between a moving part and a surface that is an obstacle for it.
struct TrajectoryClearance {
  LeastClearance least;
  std::optional<std::size_t> sphere{};    ///< index of the sphere, or
  std::optional<std::size_t> attached{};  ///< index of the attached object
};

struct TrajectoryAnswer {
  bool is_valid = true;
  bool is_unknown = false;                  ///< enters unseen space before any contact
  std::vector<TrajectoryContact> contacts;  ///< in order of time
  /// With clearance, if a surface is within max_distance_m of the robot: see ClearanceQuery. The first contact instead
  /// if it is deeper.
  std::optional<TrajectoryClearance> clearance{};
};

/// Checks trajectories of robots, as spheres, with their attached objects: see SweepQuery. Attached objects are the
/// spheres of AttachedShape, which exceed them by up to half a voxel's diagonal. Immutable, thread-safe.
class TrajectoryQuery {
 public:
  /// RESOURCE_EXHAUSTED if an attached object has more than kMostBalls surface voxels, too many for a carried object.
  /// CANCELLED on a `stop` request during the preparation of attached objects.
  static Result<TrajectoryQuery> Make(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options,
                                      const std::stop_token& stop = {});
  static constexpr std::size_t kMostBalls = 50'000;

  /// CANCELLED soon after a `stop` request, or if `work` runs out.
  [[nodiscard]] Result<TrajectoryAnswer> Check(const RobotMotion& motion, const std::stop_token& stop = {},
                                               WorkBudget* work = nullptr) const;

 private:
  struct Carried {
    AttachedShape body;
    SweepQuery query;
    std::optional<ClearanceQuery> clearance{};
  };
  TrajectoryQuery(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options);
  [[nodiscard]] SweepQuery QueryOf(const std::vector<SubmapId>& may_touch) const;

  /// Adds the contacts of one part of the robot; incomplete after `stop`. `sweep(query, until)` finds its first
  /// contact.
  template <typename Sweep>
  void Add(const SweepQuery& query, const TrajectoryContact& part, const Sweep& sweep, const std::stop_token& stop,
           WorkBudget* work, TrajectoryAnswer& answer, double& unknown_at) const;
  [[nodiscard]] std::optional<TrajectoryClearance> ClearanceOf(const RobotMotion& motion, const std::stop_token& stop,
                                                               WorkBudget* work) const;
  /// Returns partial results soon after a `stop` request.
  [[nodiscard]] static SweepAnswer SweepAttached(const SweepQuery& query, const AttachedShape& body,
                                                 const RigidPath& path, double until, const std::stop_token& stop,
                                                 WorkBudget* work);

  TrajectoryOptions options_;
  std::shared_ptr<const MapSurfaces> surfaces_;
  std::vector<SweepQuery> spheres_;       ///< by list of allowed contacts
  std::vector<ClearanceQuery> clear_of_;  ///< the same, if clearance is wanted
  std::vector<Carried> carried_;
};

}  // namespace dhpmap
