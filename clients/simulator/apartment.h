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

/// Inside of a room between the faces of its walls, seen from above, and the lamp on its ceiling.
struct Room {
  const char* name;
  double min_x_m, max_x_m, min_y_m, max_y_m;
  Eigen::Vector3d lamp_m;
};

/// Floor at z = 0. All rooms lie in 0..11 x 0..8 m.
inline constexpr double kRoomHeight_m = 2.6;

/// The furnished apartment: living room, bedroom, bath, study and kitchen, with doorways from each to the next and
/// back. Exact: made of solids, not of triangles or voxels. Immutable, so thread-safe.
class ApartmentScene {
 public:
  enum class Ceiling { kClosed, kOpen };
  /// kOpen leaves out the ceiling and what hangs from it, for views from above.
  explicit ApartmentScene(Ceiling ceiling = Ceiling::kClosed);

  using Hit = BoundingTree::Hit;
  /// What the ray meets first within max_m; its solid is null if that is nothing.
  [[nodiscard]] Hit Cast(const Ray& ray, double max_m = kFar_m) const { return tree_.Cast(ray, max_m); }

  /// Signed distance (m, map frame) to the nearest surface: exact in free space, negative inside solids.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p_map) const { return tree_.Closest(p_map).distance_m; }
  /// Ground-truth id of the nearest solid (1..255), or of the one around p.
  [[nodiscard]] std::uint8_t InstanceAt(const Eigen::Vector3d& p_map) const {
    return tree_.Closest(p_map).solid->instance;
  }

  /// By id; 0 stands for nothing.
  [[nodiscard]] std::span<const Instance> instances() const { return instances_; }
  [[nodiscard]] const Material& MaterialOf(const Solid& solid) const { return materials_[solid.material]; }
  [[nodiscard]] const BoundingTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return tree_.solids(); }
  static std::span<const Room> Rooms();

  /// The same instances and materials with other solids.
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

/// The parts of the apartment; each adds to the scene.
void AddWallsAndFloors(SceneBuilder& scene);
void AddCeiling(SceneBuilder& scene);  ///< with the lamps on it
void FurnishLivingRoom(SceneBuilder& scene);
void FurnishBedroom(SceneBuilder& scene);
void FurnishBath(SceneBuilder& scene);
void FurnishStudy(SceneBuilder& scene);
void FurnishKitchen(SceneBuilder& scene);

}  // namespace dhpmap::simulator
