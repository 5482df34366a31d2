// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "mapping/geometry/triangle_tree.h"
#include "mapping/map/map.h"
#include "mapping/mesh/tile_surface.h"
#include "tests/support/scenes.h"

// Maps of analytic solids, and all triangles of their surfaces, to compare queries with.

namespace dhpmap::testing {

inline constexpr double kSceneVoxel_m = 0.05, kSceneTruncation_m = 0.15;

/// Signed distance, positive outside, in the submap's own frame.
using SolidDistance = std::function<double(const Eigen::Vector3d&)>;

inline SolidDistance Ball(const Eigen::Vector3d& center_m, double radius_m) {
  return [=](const Eigen::Vector3d& p) { return (p - center_m).norm() - radius_m; };
}
inline SolidDistance Block(const Eigen::Vector3d& center_m, const Eigen::Vector3d& half_m) {
  const Solid solid{.shape = Solid::Shape::kBox, .center_m = center_m, .size_m = half_m};
  return [=](const Eigen::Vector3d& p) { return solid.Distance(p); };
}
/// The inside of a room.
inline SolidDistance Room(const Eigen::Vector3d& center_m, const Eigen::Vector3d& half_m) {
  return [block = Block(center_m, half_m)](const Eigen::Vector3d& p) { return -block(p); };
}

/// Writes the band around a solid within `box`, where `is_mine` says so.
inline void ObserveBand(Submap& submap, const SolidDistance& distance, const Eigen::AlignedBox3d& box,
                        const std::function<bool(const Eigen::Vector3d&)>& is_mine = {}) {
  const VoxelIndex low = VoxelAt(box.min(), kSceneVoxel_m), high = VoxelAt(box.max(), kSceneVoxel_m);
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const Eigen::Vector3d centre = VoxelCentre({x, y, z}, kSceneVoxel_m);
        const double d = distance(centre);
        if (std::abs(d) > kSceneTruncation_m || (is_mine && !is_mine(centre))) continue;
        TsdfBlock& block = submap.MutableTsdf(BlockOf({x, y, z}));
        const auto i = static_cast<std::size_t>(LinearIndex({x, y, z}));
        block.distance_m[i] = static_cast<float>(d);
        block.weight[i] = 1;
      }
    }
  }
  submap.UpdateBoundingSphere();
}

/// Marks the voxels whose centres `is_free` as looked through.
inline void LookThrough(Map& map, const Eigen::AlignedBox3d& box,
                        const std::function<bool(const Eigen::Vector3d&)>& is_free) {
  std::map<TileIndex, FreeBlocks> tiles;
  const VoxelIndex low = VoxelAt(box.min(), kSceneVoxel_m), high = VoxelAt(box.max(), kSceneVoxel_m);
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const VoxelIndex voxel{x, y, z};
        if (!is_free(VoxelCentre(voxel, kSceneVoxel_m))) continue;
        const int cell = CellOf(BlockOf(voxel)), linear = LinearIndex(voxel);
        FreeBlocks& seen = tiles[TileOf(BlockOf(voxel))];
        seen.mixed |= std::uint64_t{1} << cell;
        seen.masks[static_cast<std::size_t>(cell)][static_cast<std::size_t>(linear >> 6)] |= std::uint64_t{1}
                                                                                             << (linear & 63);
      }
    }
  }
  for (const auto& [index, seen] : tiles) map.mutable_free_space().Add(index, seen, 0);
}

inline MapInfo SceneInfo() {
  MapInfo info;
  info.name = "m";
  info.config.voxel_size_m = kSceneVoxel_m;
  info.config.truncation_m = kSceneTruncation_m;
  info.label_set = MakeLabelSet(2, 1);
  return info;
}

inline Submap& AddThing(Map& map, ClassId class_id = ClassId(1), const Transform& T = Transform::Identity()) {
  return map.Create({.panoptic = Panoptic::kThing,
                     .class_id = class_id,
                     .T_map_submap = T,
                     .voxel_size_m = kSceneVoxel_m,
                     .truncation_m = kSceneTruncation_m});
}

inline Eigen::AlignedBox3d CubeAt(const Eigen::Vector3d& center_m, double half_m) {
  return {center_m - Eigen::Vector3d::Constant(half_m), center_m + Eigen::Vector3d::Constant(half_m)};
}

inline Transform RandomPose(std::mt19937& random, double spread_m) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Transform T = Transform::Identity();
  T.translate(spread_m * Eigen::Vector3d{unit(random), unit(random), unit(random)});
  T.rotate(Eigen::AngleAxisd(3 * unit(random), Eigen::Vector3d{unit(random), unit(random), 1.5}.normalized()));
  return T;
}

/// A ball, a block and a ball in a room, each a submap of its own, and a block of the unknown submap; nothing overlaps.
inline Map FurnishedRoom() {
  Map map(SceneInfo());
  const Eigen::Vector3d ball(0.61, 0.52, 0.43), block(-0.7, -0.6, -0.2), small(-0.55, 0.8, 0.9),
      nobody(0.9, -0.9, -0.8);
  ObserveBand(AddThing(map, ClassId(1)), Ball(ball, 0.4), CubeAt(ball, 0.6));
  ObserveBand(AddThing(map, ClassId(2)), Block(block, {0.3, 0.25, 0.4}), CubeAt(block, 0.6));
  ObserveBand(AddThing(map, ClassId(1)), Ball(small, 0.2), CubeAt(small, 0.4));
  Submap& room = AddThing(map, ClassId(3));
  room.mutable_info().panoptic = Panoptic::kStuff;
  ObserveBand(room, Room({0, 0, 0}, {1.52, 1.51, 1.53}), CubeAt({0, 0, 0}, 1.8));
  ObserveBand(*map.FindMutable(kUnknownSubmap), Block(nobody, {0.2, 0.2, 0.2}), CubeAt(nobody, 0.4));
  return map;
}

/// The same with things moved, turned and cloned, some into one another.
inline Map DisarrayedRoom(unsigned seed) {
  Map map = FurnishedRoom();
  std::mt19937 random(seed);
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap = RandomPose(random, 0.5);
  map.Clone(SubmapId(1))->mutable_info().T_map_submap = RandomPose(random, 0.8);
  map.Clone(kUnknownSubmap)->mutable_info().T_map_submap = RandomPose(random, 0.8);
  FreeBlocks seen;
  seen.full = 0x00FF00FF0F0F0F0Full;
  for (int k = -1; k < 1; ++k) map.mutable_free_space().Add({k, 0, -1 - k}, seen, 1);
  return map;
}

/// The triangles of one submap in the map frame.
inline std::vector<std::array<Eigen::Vector3d, 3>> TrianglesInMap(const Submap& submap) {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  const double size_m = submap.info().voxel_size_m;
  for (const TileEntry& tile : submap.blocks().tiles()) {
    const Eigen::Vector3d corner = TileCorner(tile.index, size_m);
    for (const SurfaceTriangle& local :
         ExtractTileSurface(FindBlocks(FindNeighbourhood(submap.blocks(), tile.index), tile.index), size_m)) {
      auto& triangle = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = submap.info().T_map_submap * (corner + local[i].cast<double>());
      }
    }
  }
  return triangles;
}

/// Distance from a point to a triangle, by its plane and its edges: slow and obvious.
inline double DistanceToTriangle(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& t) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d edge = t[(i + 1) % 3] - t[i];
    const double along = std::clamp((p - t[i]).dot(edge) / std::max(edge.squaredNorm(), 1e-30), 0.0, 1.0);
    best = std::min(best, (p - t[i] - along * edge).norm());
  }
  const Eigen::Vector3d across = (t[1] - t[0]).cross(t[2] - t[0]);
  if (across.norm() < 1e-15) return best;
  const Eigen::Vector3d normal = across.normalized();
  const Eigen::Vector3d foot = p - normal.dot(p - t[0]) * normal;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((t[(i + 1) % 3] - t[i]).cross(foot - t[i]).dot(normal) < 0) return best;
  }
  return (p - foot).norm();
}

/// What is nearest of all submaps that `holds` accepts, by looking at every triangle.
struct BruteNearest {
  double distance_m = std::numeric_limits<double>::infinity();
  SubmapId submap;
};
class AllTriangles {
 public:
  explicit AllTriangles(const MapSnapshot& map, const std::function<bool(const SubmapInfo&)>& holds = {}) {
    for (const auto& submap : map.submaps()) {
      if (!holds || holds(submap->info())) parts_.emplace_back(submap->id(), TrianglesInMap(*submap));
    }
  }
  [[nodiscard]] BruteNearest Nearest(const Eigen::Vector3d& p) const {
    BruteNearest best;
    for (const auto& [id, triangles] : parts_) {
      for (const auto& triangle : triangles) {
        const double distance_m = DistanceToTriangle(p, triangle);
        if (distance_m < best.distance_m) best = {distance_m, id};
      }
    }
    return best;
  }

 private:
  std::vector<std::pair<SubmapId, std::vector<std::array<Eigen::Vector3d, 3>>>> parts_;
};

inline std::vector<Eigen::Vector3d> RandomPoints(int count, double half_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-half_m, half_m);
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) points.push_back({unit(random), unit(random), unit(random)});  // in this order
  return points;
}

}  // namespace dhpmap::testing
