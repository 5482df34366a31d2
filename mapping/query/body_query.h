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

/// How a check treats unseen space.
enum class UnknownSpace : std::uint8_t {
  kOccupied,  ///< an obstacle
  kReported,  ///< no obstacle, but reported
  kFree,      ///< no obstacle
};

/// A contact of a body with a submap, or with unseen space.
struct BodyContact {
  const SubmapInfo* submap = nullptr;  ///< null: unseen space. Valid as long as the surfaces
  /// Penetration depth. For a sphere, radius minus centre distance; else the shortest translation along the normal of a
  /// touched triangle that ends the contact. 0 in unseen space.
  double depth_m = 0;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< on the surface; for unseen space a voxel's centre
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< out of the surface, unit; zero for unseen space
};

/// The answer for a body.
struct BodyAnswer {
  bool is_colliding = false;
  bool is_unknown = false;            ///< no contact, but partly in unseen space
  std::vector<BodyContact> contacts;  ///< at most one for unseen space
};

struct BodyOptions {
  double max_distance_m = 3;  ///< maximum depth inside an object at which a body is detected
  UnknownSpace unknown = UnknownSpace::kOccupied;
  QueryScope scope;
};

/// Collision checks of bodies against a state of a map: surfaces, grown by their padding; the inside of objects (where
/// DistanceQuery is negative); and, on request, unseen space (VisitUnseen). A sphere touches everything within its
/// radius. Bodies are in the map frame. Immutable, thread-safe.
class BodyQuery {
 public:
  BodyQuery(std::shared_ptr<const MapSurfaces> surfaces, BodyOptions options);

  // If `work` runs out, the answer is meaningless.
  /// Stops at the first contact and does not report it.
  [[nodiscard]] BodyAnswer Test(const Body& body, WorkBudget* work = nullptr) const;
  /// One contact for each object that it touches, the deepest first, at most `max_contacts`.
  [[nodiscard]] BodyAnswer Check(const Body& body, std::size_t max_contacts = 1, WorkBudget* work = nullptr) const;

  /// The object that contains a point, if any: where its distance is negative.
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
  /// Adds the result of unseen space for a body without contacts.
  template <typename Shape>
  void AddUnseen(const Shape& body, BodyAnswer& answer, WorkBudget* work) const;

  BodyOptions options_;
  QueryWorld world_;
  DistanceQuery distances_;
};

}  // namespace dhpmap
