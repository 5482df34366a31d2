// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "clients/simulator/bounding_tree.h"
#include "clients/simulator/material.h"
#include "clients/simulator/scene_builder.h"

namespace dhpmap::simulator {

/// A room's interior between its wall faces, from above, and the position of its ceiling lamp.
struct Room {
  const char* name;
  double min_x_m, max_x_m, min_y_m, max_y_m;
  Eigen::Vector3d lamp_m;
};

/// Floor at z = 0. All rooms lie in 0..11 x 0..8 m.
inline constexpr double kRoomHeight_m = 2.6;

/// The furnished apartment: living room, bedroom, bath, study and kitchen, connected by doorways in a cycle. Exact:
/// made of solids, not of triangles or voxels. Immutable, so thread-safe.
class ApartmentScene {
 public:
  enum class Ceiling { kClosed, kOpen };
  /// kOpen leaves out the ceiling and the things on it, for views from above.
  explicit ApartmentScene(Ceiling ceiling = Ceiling::kClosed);

  using Hit = BoundingTree::Hit;
  /// The first hit of the ray within max_m; its solid is null if there is none.
  [[nodiscard]] Hit Cast(const Ray& ray, double max_m = kFar_m) const { return tree_.Cast(ray, max_m); }

  /// Signed distance (m, map frame) to the nearest surface: exact in free space, negative inside solids.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p_map) const { return tree_.Closest(p_map).distance_m; }
  /// Ground-truth id (1..255) of the nearest solid, or of the solid that contains p.
  [[nodiscard]] std::uint8_t InstanceAt(const Eigen::Vector3d& p_map) const {
    return tree_.Closest(p_map).solid->instance;
  }

  /// By id; 0 means none.
  [[nodiscard]] std::span<const Instance> instances() const { return instances_; }
  [[nodiscard]] const Material& MaterialOf(const Solid& solid) const { return materials_[solid.material]; }
  [[nodiscard]] const BoundingTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return tree_.solids(); }
  static std::span<const Room> Rooms();

  /// A scene with other solids and the same instances and materials.
  [[nodiscard]] ApartmentScene WithSolids(std::vector<Solid> solids) const {
    return {instances_, materials_, std::move(solids)};
  }

 private:
  ApartmentScene(std::vector<Instance> instances, std::vector<Material> materials, std::vector<Solid> solids)
      : instances_(std::move(instances)), materials_(std::move(materials)), tree_(std::move(solids)) {}
  explicit ApartmentScene(const SceneBuilder& builder);

  std::vector<Instance> instances_;
  std::vector<Material> materials_;
  BoundingTree tree_;
};

/// Parts of the apartment; each function adds to the scene.
void AddWallsAndFloors(SceneBuilder& scene);
void AddCeiling(SceneBuilder& scene);  ///< with the lamps on it
void FurnishLivingRoom(SceneBuilder& scene);
void FurnishBedroom(SceneBuilder& scene);
void FurnishBath(SceneBuilder& scene);
void FurnishStudy(SceneBuilder& scene);
void FurnishKitchen(SceneBuilder& scene);

}  // namespace dhpmap::simulator
