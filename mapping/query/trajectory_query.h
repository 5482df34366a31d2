// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/geometry/moving_sphere.h"
#include "mapping/query/carried_body.h"
#include "mapping/query/clearance_query.h"
#include "mapping/query/sweep_query.h"
#include "mapping/query/touch_lists.h"

namespace dhpmap {

/// What a robot carries, and may touch with it.
struct AttachedObject {
  SubmapId submap;
  std::vector<SubmapId> may_touch;
};

/// A motion of the map frame, through the same number of waypoints for all parts of the robot: spheres at each of them,
/// or a rigid robot.
struct RobotMotion {
  std::vector<std::vector<SphereKnot>> spheres;  ///< of each its knots
  std::vector<CarriedBody::Ball> robot;          ///< numbered after those
  std::vector<Transform> waypoints;              ///< T_map_robot
  std::vector<std::vector<Transform>> attached;  ///< T_map_submap of what is attached, in its order, at each waypoint
};

struct TrajectoryOptions {
  BodyOptions bodies;  ///< whose scope has all that is attached
  std::vector<AttachedObject> attached;
  TouchLists spheres{};  ///< what each of the spheres may touch, and of the robot
  /// 1: the first of all. More: the first of each part of the robot with each object, the earliest so many; the first
  /// of a part may be with the inside of an object, the others are with surfaces.
  std::size_t max_contacts = 1;
  bool with_clearance = false;  ///< tell how near each motion comes to surfaces
};

/// What some part of a robot meets first of some object.
struct TrajectoryContact {
  double at;                            ///< when, in waypoints
  std::optional<std::size_t> sphere;    ///< which of the spheres, or
  std::optional<std::size_t> attached;  ///< which of what is attached
  BodyContact contact;
  double depth_then_m = 0;  ///< see SweepContact
};

/// Where a motion is nearest to a surface that is in the way of the part that is so near.
struct TrajectoryClearance {
  LeastClearance least;
  std::optional<std::size_t> sphere{};    ///< which of the spheres, or
  std::optional<std::size_t> attached{};  ///< which of what is attached
};

struct TrajectoryAnswer {
  bool is_valid = true;
  bool is_unknown = false;                  ///< before it meets any surface it is where nobody has seen
  std::vector<TrajectoryContact> contacts;  ///< the first first
  /// With clearance, if there is a surface within max_distance_m of the robot: see ClearanceQuery. If the first contact
  /// is deeper when it is met, that.
  std::optional<TrajectoryClearance> clearance{};
};

/// Whether robots, as spheres, can go along trajectories with what they carry: see SweepQuery. What is carried is there
/// as the spheres of CarriedBody, which stick out by up to half a voxel's diagonal. Immutable, thread-safe.
class TrajectoryQuery {
 public:
  /// RESOURCE_EXHAUSTED if something attached has more than kMostBalls voxels of surface: no robot carries it.
  /// CANCELLED if `stop` is requested before the last of what is attached is looked at.
  static Result<TrajectoryQuery> Make(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options,
                                      const std::stop_token& stop = {});
  static constexpr std::size_t kMostBalls = 50'000;

  /// CANCELLED soon after `stop` is requested, or `work` is over.
  [[nodiscard]] Result<TrajectoryAnswer> Check(const RobotMotion& motion, const std::stop_token& stop = {},
                                               WorkBudget* work = nullptr) const;

 private:
  struct Carried {
    CarriedBody body;
    SweepQuery query;
    std::optional<ClearanceQuery> clearance{};
  };
  TrajectoryQuery(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options);
  [[nodiscard]] SweepQuery QueryOf(const std::vector<SubmapId>& may_touch) const;

  /// Adds what one part of the robot meets. `sweep(query, until)` finds the first of it. After `stop` not all of it.
  template <typename Sweep>
  void Add(const SweepQuery& query, const TrajectoryContact& part, const Sweep& sweep, const std::stop_token& stop,
           WorkBudget* work, TrajectoryAnswer& answer, double& unknown_at) const;
  [[nodiscard]] std::optional<TrajectoryClearance> ClearanceOf(const RobotMotion& motion, const std::stop_token& stop,
                                                               WorkBudget* work) const;
  /// Ends soon after `stop` is requested, with what it has.
  [[nodiscard]] static SweepAnswer SweepCarried(const SweepQuery& query, const CarriedBody& body, const RigidPath& path,
                                                double until, const std::stop_token& stop, WorkBudget* work);

  TrajectoryOptions options_;
  std::shared_ptr<const MapSurfaces> surfaces_;
  std::vector<SweepQuery> spheres_;       ///< by list of what they may touch
  std::vector<ClearanceQuery> clear_of_;  ///< the same, if that is asked for
  std::vector<Carried> carried_;
};

}  // namespace dhpmap
