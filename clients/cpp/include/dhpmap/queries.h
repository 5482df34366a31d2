// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dhpmap/answers.h"
#include "dhpmap/options.h"
#include "dhpmap/result.h"
#include "dhpmap/space.h"

namespace dhpmap::client {

class Source;  // inner: where queries go

/// Which objects to look for: those that pass all that is given, by their surfaces.
struct FindOptions {
  std::optional<Vector3> near_m;  ///< the nearest first, up to query.max_distance_m if that is given; else by id
  std::optional<Region> within;
  std::string name;  ///< a part of the display name
  int limit = 100;   ///< objects at most
  QueryOptions query;
};

/// What can be asked of a map. Each answer is of one state of the map, and says which; more than a million points go in
/// several calls, all of that state. Errors: InvalidArgument for what cannot be asked so, NotFound for an object or map
/// that is not there, OutOfRange for a revision that is not kept, Unavailable, DeadlineExceeded.
/// Safe for use from several threads, unless a class that has it says otherwise.
class Queries {
 public:
  virtual ~Queries();
  Queries(const Queries&) = default;
  Queries& operator=(const Queries&) = default;

  /// How far is the nearest surface of each point, which way, and whose is it?
  Result<Answers<Distance>> Distances(std::span<const Vector3> points_m, const QueryOptions& options = {}) const;
  /// What is at each point? Of the options it takes T_map_query and min_revision.
  Result<Answers<PointState>> Points(std::span<const Vector3> points_m, const QueryOptions& options = {}) const;
  /// What does each ray meet first?
  Result<Answers<RayHit>> CastRays(std::span<const Ray> rays, const QueryOptions& options = {}) const;
  /// Does each ball touch anything? Unseen space is in the way.
  Result<Answers<Collision>> Collisions(std::span<const Sphere> spheres_m, const QueryOptions& options = {}) const;
  /// The same of balls, boxes and capsules, with their contacts.
  Result<Answers<BodyCheck>> CheckBodies(std::span<const Body> bodies, const QueryOptions& options = {},
                                         const CheckOptions& check = {}) const;

  /// Can the robot go through these poses T_map_robot, evenly from each to the next, without touching anything? What is
  /// between them counts, too. Unseen space is in the way, unless options.unknown is kFree.
  Result<PathCheck> CheckPath(const Spheres& robot, std::span<const Pose> waypoints, const QueryOptions& options = {},
                              const CheckOptions& check = {}) const;
  /// The same of several paths.
  Result<Answers<PathCheck>> CheckPaths(const Spheres& robot, std::span<const std::vector<Pose>> paths,
                                        const QueryOptions& options = {}, const CheckOptions& check = {}) const;
  /// Can the robot be at these poses T_map_robot, each by itself?
  Result<Answers<PathCheck>> CheckPoses(const Spheres& robot, std::span<const Pose> poses,
                                        const QueryOptions& options = {}, const CheckOptions& check = {}) const;

  /// Objects of a class; "": of any. InvalidArgument for a class that the map does not know.
  Result<std::vector<Object>> Find(std::string_view class_name, const FindOptions& options = {}) const;

  /// What is occupied and free between two heights? A map for a robot that drives.
  Result<client::Slice> Slice(const SliceOptions& options = {}) const;
  /// The distances at the nodes of a grid that fills a box, every resolution_m (0.001 to 100) from its least corner on.
  Result<DistanceGrid> Grid(const Box& box, double resolution_m, const QueryOptions& options = {}) const;
  /// What is on, in and next to what, by subject, object and kind.
  Result<std::vector<Relation>> Relations(const RelationOptions& options = {}) const;

 protected:
  explicit Queries(std::shared_ptr<Source> source);
  [[nodiscard]] const std::shared_ptr<Source>& source() const { return source_; }

 private:
  std::shared_ptr<Source> source_;
};

/// A map as it was at one revision. Those that Map::Pin makes hold the state for 10 s at a time, and after that as long
/// as the server keeps it: then OutOfRange, reason REVISION_NOT_KEPT.
/// Safe for use from several threads, which take turns.
class Pinned final : public Queries {
 public:
  [[nodiscard]] std::int64_t revision() const { return revision_; }

 private:
  friend class Map;
  Pinned(std::shared_ptr<Source> source, std::int64_t revision);

  std::int64_t revision_;
};

/// Queries on one stream, for control loops: less to do a query than by calls of Map. Goes on over a new connection
/// when one is lost, pinned as before. For one thread at a time.
class Loop final : public Queries {
 public:
  /// From here on queries are of the present state, or of a past revision: for 10 s at most, then FailedPrecondition
  /// until the next pin. The revision.
  Result<std::int64_t> Pin(std::int64_t revision = 0);
  /// Queries are of the present again.
  Status Unpin();

 private:
  friend class Map;
  explicit Loop(std::shared_ptr<Source> source);
};

}  // namespace dhpmap::client
