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

class Source;  // internal: the transport of queries

/// Conditions of a search: objects whose surface satisfies all of them.
struct FindOptions {
  std::optional<Vector3> near_m;  ///< sorts by distance, up to query.max_distance_m if given; else by id
  std::optional<Region> within;
  std::string name;  ///< a part of the display name
  int limit = 100;   ///< maximum number of objects
  QueryOptions query;
};

/// Queries of a map. Each answer is from one state of the map and names its revision. More than a million points are
/// sent in several calls on the same state. Errors: InvalidArgument for invalid arguments, NotFound for a missing
/// object or map, OutOfRange for a revision that is not kept, Unavailable, DeadlineExceeded. Thread-safe, unless a
/// derived class says otherwise.
class Queries {
 public:
  virtual ~Queries();
  Queries(const Queries&) = default;
  Queries& operator=(const Queries&) = default;

  /// The distance and direction of the nearest surface of each point, and its object.
  Result<Answers<Distance>> Distances(std::span<const Vector3> points_m, const QueryOptions& options = {}) const;
  /// The state of each point. Supports only the options T_map_query and min_revision.
  Result<Answers<PointState>> Points(std::span<const Vector3> points_m, const QueryOptions& options = {}) const;
  /// The first hit of each ray.
  Result<Answers<RayHit>> CastRays(std::span<const Ray> rays, const QueryOptions& options = {}) const;
  /// Whether each sphere collides. Unobserved space blocks.
  Result<Answers<Collision>> Collisions(std::span<const Sphere> spheres_m, const QueryOptions& options = {}) const;
  /// The same for spheres, boxes and capsules, with their contacts.
  Result<Answers<BodyCheck>> CheckBodies(std::span<const Body> bodies, const QueryOptions& options = {},
                                         const CheckOptions& check = {}) const;

  /// Whether the robot can move through these poses T_map_robot, interpolated from each to the next, without contact.
  /// Motions between poses are checked, too. Unobserved space blocks, unless options.unknown is kFree.
  Result<PathCheck> CheckPath(const Spheres& robot, std::span<const Pose> waypoints, const QueryOptions& options = {},
                              const CheckOptions& check = {}) const;
  /// The same for several paths.
  Result<Answers<PathCheck>> CheckPaths(const Spheres& robot, std::span<const std::vector<Pose>> paths,
                                        const QueryOptions& options = {}, const CheckOptions& check = {}) const;
  /// Whether the robot can be at each of these poses T_map_robot.
  Result<Answers<PathCheck>> CheckPoses(const Spheres& robot, std::span<const Pose> poses,
                                        const QueryOptions& options = {}, const CheckOptions& check = {}) const;

  /// Objects of a class; "": of all classes. InvalidArgument for a class that the map does not have.
  Result<std::vector<Object>> Find(std::string_view class_name, const FindOptions& options = {}) const;

  /// Occupied and free space in a height band: a map for a driving robot.
  Result<client::Slice> Slice(const SliceOptions& options = {}) const;
  /// Distances at the nodes of a grid in a box, with spacing resolution_m (0.001 to 100) from its minimum corner.
  Result<DistanceGrid> Grid(const Box& box, double resolution_m, const QueryOptions& options = {}) const;
  /// Which objects are on, in or next to others, sorted by subject, object and kind.
  Result<std::vector<Relation>> Relations(const RelationOptions& options = {}) const;

 protected:
  explicit Queries(std::shared_ptr<Source> source);
  [[nodiscard]] const std::shared_ptr<Source>& source() const { return source_; }

 private:
  std::shared_ptr<Source> source_;
};

/// A map at one revision. Map::Pin makes the server hold the state for 10 s, renewed by queries; after that the state
/// is available as long as the server keeps it: then OutOfRange, reason REVISION_NOT_KEPT. Thread-safe; threads take
/// turns.
class Pinned final : public Queries {
 public:
  [[nodiscard]] std::int64_t revision() const { return revision_; }

 private:
  friend class Map;
  Pinned(std::shared_ptr<Source> source, std::int64_t revision);

  std::int64_t revision_;
};

/// A map as the contacted server has it: see Map::Eventual. Thread-safe.
class EventualMap final : public Queries {
 private:
  friend class Map;
  explicit EventualMap(std::shared_ptr<Source> source);
};

/// Queries on one stream, for control loops: less to do a query than by calls of Map. Goes on over a new connection
/// when one is lost, pinned as before. For one thread at a time.
class Loop final : public Queries {
 public:
  /// Pins the current state, or a past revision, for later queries: for 10 s at most, then FailedPrecondition until the
  /// next pin. Returns the revision.
  Result<std::int64_t> Pin(std::int64_t revision = 0);
  /// Later queries use the current state again.
  Status Unpin();

 private:
  friend class Map;
  explicit Loop(std::shared_ptr<Source> source);
};

}  // namespace dhpmap::client
