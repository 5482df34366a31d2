// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/query/carried_body.h"
#include "mapping/query/moving_sphere.h"
#include "mapping/query/sweep_query.h"

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
  /// 1: the first of all. More: the first of each part of the robot with each object, the earliest so many; the first
  /// of a part may be with the inside of an object, the others are with surfaces.
  std::size_t max_contacts = 1;
};

/// What some part of a robot meets first of some object.
struct TrajectoryContact {
  double at;                            ///< when, in waypoints
  std::optional<std::size_t> sphere;    ///< which of the spheres, or
  std::optional<std::size_t> attached;  ///< which of what is attached
  BodyContact contact;
};

struct TrajectoryAnswer {
  bool is_valid = true;
  bool is_unknown = false;                  ///< before it meets any surface it is where nobody has seen
  std::vector<TrajectoryContact> contacts;  ///< the first first
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
    SweepQuery query;  ///< without what it may touch
  };
  TrajectoryQuery(std::shared_ptr<const MapSurfaces> surfaces, TrajectoryOptions options)
      : options_(std::move(options)), surfaces_(surfaces), robot_(std::move(surfaces), options_.bodies) {}

  /// Adds what one part of the robot meets. `sweep(query, until)` finds the first of it. After `stop` not all of it.
  template <typename Sweep>
  void Add(const SweepQuery& query, const TrajectoryContact& part, const Sweep& sweep, const std::stop_token& stop,
           WorkBudget* work, TrajectoryAnswer& answer, double& unknown_at) const;
  /// Ends soon after `stop` is requested, with what it has.
  [[nodiscard]] static SweepAnswer SweepCarried(const SweepQuery& query, const CarriedBody& body, const RigidPath& path,
                                                double until, const std::stop_token& stop, WorkBudget* work);

  TrajectoryOptions options_;
  std::shared_ptr<const MapSurfaces> surfaces_;
  SweepQuery robot_;
  std::vector<Carried> carried_;
};

}  // namespace dhpmap
