// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mapping/geometry/body.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/query_scope.h"
#include "mapping/query/query_world.h"
#include "mapping/query/work_budget.h"

namespace dhpmap {

/// What space that nobody has seen is for a check.
enum class UnknownSpace : std::uint8_t {
  kOccupied,  ///< in the way
  kReported,  ///< not in the way, and told
  kFree,      ///< not in the way
};

/// Where a body touches a submap, or is in space that nobody has seen.
struct BodyContact {
  const SubmapInfo* submap = nullptr;  ///< null: unseen space. Valid as long as the surfaces
  /// How deep. Of a sphere its radius less the distance of its centre; else the least way along the normal of a
  /// triangle that it touches which takes it to the front of that. 0 in unseen space.
  double depth_m = 0;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< on the surface; of unseen space a voxel's centre
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< out of the surface, unit; of unseen space zero
};

/// What is said of a body.
struct BodyAnswer {
  bool is_colliding = false;
  bool is_unknown = false;            ///< it touches nothing, but is in part where nobody has seen
  std::vector<BodyContact> contacts;  ///< of unseen space one at most
};

struct BodyOptions {
  double max_distance_m = 3;  ///< so deep inside an object a body is found to be so
  UnknownSpace unknown = UnknownSpace::kOccupied;
  QueryScope scope;
};

/// Whether bodies touch what there is in a state of a map: a surface, which may be grown by its padding, the inside of
/// an object (where DistanceQuery is negative), or, if so asked, space that nobody has seen (VisitUnseen). A sphere
/// touches what is no farther from its centre than its radius. Bodies are of the map frame. Immutable, thread-safe.
class BodyQuery {
 public:
  BodyQuery(std::shared_ptr<const MapSurfaces> surfaces, BodyOptions options);

  // Where `work` is over in between, the answer means nothing.
  /// Ends at the first contact it finds, and tells none.
  [[nodiscard]] BodyAnswer Test(const Body& body, WorkBudget* work = nullptr) const;
  /// With a contact for each object that it touches, the deepest first, up to `max_contacts`.
  [[nodiscard]] BodyAnswer Check(const Body& body, std::size_t max_contacts = 1, WorkBudget* work = nullptr) const;

  /// Whose inside a place is, if anybody's: where its distance is negative.
  [[nodiscard]] std::optional<SurfaceDistance> InsideOf(const Eigen::Vector3d& p_map) const;

 private:
  [[nodiscard]] std::vector<BodyContact> Contacts(const Capsule& capsule, std::size_t max_contacts,
                                                  WorkBudget* work) const;
  [[nodiscard]] std::vector<BodyContact> Contacts(const OrientedBox& box, std::size_t max_contacts,
                                                  WorkBudget* work) const;
  template <typename Shape>
  [[nodiscard]] std::vector<BodyContact> TriangleContacts(const Shape& body, std::size_t max_contacts,
                                                          WorkBudget* work) const;
  [[nodiscard]] bool TouchesAny(const Capsule& capsule, WorkBudget* work) const;
  [[nodiscard]] bool TouchesAny(const OrientedBox& box, WorkBudget* work) const;
  template <typename Shape>
  [[nodiscard]] bool TouchesTriangle(const Shape& body, WorkBudget* work) const;
  template <typename Shape>
  [[nodiscard]] BodyAnswer TestShape(const Shape& body, WorkBudget* work) const;
  template <typename Shape>
  [[nodiscard]] BodyAnswer CheckShape(const Shape& body, std::size_t max_contacts, WorkBudget* work) const;
  /// Adds what unseen space means for a body that touches nothing.
  template <typename Shape>
  void AddUnseen(const Shape& body, BodyAnswer& answer, WorkBudget* work) const;

  BodyOptions options_;
  QueryWorld world_;
  DistanceQuery distances_;
};

}  // namespace dhpmap
