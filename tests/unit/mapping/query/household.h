// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "mapping/query/relations.h"
#include "tests/unit/mapping/query/surface_scene.h"

// Scenes of furniture for relations, in -2..2 x -2..2 m, with floors, walls and what was seen to be free.

namespace dhpmap::testing {

inline SolidDistance UnionOf(std::vector<SolidDistance> parts) {
  return [parts = std::move(parts)](const Eigen::Vector3d& p) {
    double least = parts[0](p);
    for (const SolidDistance& part : parts) least = std::min(least, part(p));
    return least;
  };
}

/// A board on four legs, its top at `height_m`.
inline SolidDistance Table(const Eigen::Vector3d& foot_m, const Eigen::Vector2d& half_m, double height_m) {
  const Eigen::Vector3d top = foot_m + Eigen::Vector3d(0, 0, height_m - 0.05);
  std::vector<SolidDistance> parts = {Block(top, {half_m.x(), half_m.y(), 0.05})};
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      const Eigen::Vector3d leg(x * (half_m.x() - 0.06), y * (half_m.y() - 0.06), height_m / 2);
      parts.push_back(Block(foot_m + leg, {0.05, 0.05, height_m / 2}));
    }
  }
  return UnionOf(std::move(parts));
}

/// Open to the front (-y): two sides, a back, and boards at 0, 0.6 and 1.2 m.
inline SolidDistance Shelf(const Eigen::Vector3d& foot_m) {
  std::vector<SolidDistance> parts;
  for (const double x : {-0.45, 0.45}) parts.push_back(Block(foot_m + Eigen::Vector3d(x, 0, 0.6), {0.04, 0.25, 0.65}));
  parts.push_back(Block(foot_m + Eigen::Vector3d(0, 0.25, 0.6), {0.45, 0.04, 0.65}));
  for (const double z : {0.0, 0.6, 1.2})
    parts.push_back(Block(foot_m + Eigen::Vector3d(0, 0, z + 0.04), {0.45, 0.25, 0.04}));
  return UnionOf(std::move(parts));
}

inline SolidDistance Chair(const Eigen::Vector3d& foot_m) {
  return UnionOf(
      {Table(foot_m, {0.22, 0.22}, 0.45), Block(foot_m + Eigen::Vector3d(-0.2, 0, 0.65), {0.04, 0.22, 0.25})});
}

/// Open to above: a bottom of 10 cm and four sides of 5 cm.
inline SolidDistance Crate(const Eigen::Vector3d& foot_m, double half_m, double height_m) {
  std::vector<SolidDistance> parts = {Block(foot_m + Eigen::Vector3d(0, 0, 0.05), {half_m, half_m, 0.05})};
  for (const double side : {-1, 1}) {
    const double at_m = side * (half_m - 0.025);
    parts.push_back(Block(foot_m + Eigen::Vector3d(at_m, 0, height_m / 2), {0.025, half_m, height_m / 2}));
    parts.push_back(Block(foot_m + Eigen::Vector3d(0, at_m, height_m / 2), {half_m, 0.025, height_m / 2}));
  }
  return UnionOf(std::move(parts));
}

inline SolidDistance Floor() {
  return [](const Eigen::Vector3d& p) { return p.z(); };
}

/// Objects of which each has the voxels that are nearest to it, as after label management.
class Household {
 public:
  using Place = std::function<bool(const Eigen::Vector3d&)>;  ///< map frame

  SubmapId Add(const SolidDistance& distance, Panoptic panoptic = Panoptic::kThing) {
    solids_.push_back(distance);
    Submap& submap = AddThing(map_, panoptic == Panoptic::kThing ? ClassId(1) : ClassId(3));
    submap.mutable_info().panoptic = panoptic;
    ids_.push_back(submap.id());
    return submap.id();
  }
  SubmapId AddStuff(const SolidDistance& distance) { return Add(distance, Panoptic::kStuff); }
  /// Nobody has seen what is there, of any object.
  void Hide(const Place& place) { hidden_.push_back(place); }
  /// Sensors have looked through what of the scene is there and in front of all surfaces.
  void LookThrough(const Place& place) { seen_free_.push_back(place); }

  Map& Build() {
    const Eigen::AlignedBox3d all{Eigen::Vector3d(-2, -2, -0.2), Eigen::Vector3d(2, 2, 1.7)};
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      const auto is_mine = [this, i](const Eigen::Vector3d& p) {
        if (IsIn(hidden_, p)) return false;
        for (std::size_t j = 0; j < solids_.size(); ++j) {
          if (j != i && (solids_[j](p) < solids_[i](p) || (solids_[j](p) == solids_[i](p) && j < i))) return false;
        }
        return true;
      };
      ObserveBand(*map_.FindMutable(ids_[i]), solids_[i], all, is_mine);
    }
    if (!seen_free_.empty()) AddFree(all);
    return map_;
  }

 private:
  static bool IsIn(const std::vector<Place>& places, const Eigen::Vector3d& p) {
    return std::any_of(places.begin(), places.end(), [&p](const Place& place) { return place(p); });
  }
  [[nodiscard]] bool IsInFront(const Eigen::Vector3d& p) const {
    return std::all_of(solids_.begin(), solids_.end(), [&p](const auto& solid) { return solid(p) > 0; });
  }
  void AddFree(const Eigen::AlignedBox3d& all) {
    const VoxelIndex low = VoxelAt(all.min(), kSceneVoxel_m), high = VoxelAt(all.max(), kSceneVoxel_m);
    std::map<std::tuple<int, int, int>, FreeBlocks> tiles;
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const Eigen::Vector3d centre = VoxelCentre({x, y, z}, kSceneVoxel_m);
          if (!IsIn(seen_free_, centre) || !IsInFront(centre)) continue;
          const BlockIndex block = BlockOf({x, y, z});
          const TileIndex tile = TileOf(block);
          const int i = LinearIndex({x, y, z});
          FreeBlocks& blocks = tiles[{tile.x, tile.y, tile.z}];
          blocks.mixed |= std::uint64_t{1} << CellOf(block);
          blocks.masks[static_cast<std::size_t>(CellOf(block))][static_cast<std::size_t>(i) / 64] |= std::uint64_t{1}
                                                                                                     << (i % 64);
        }
      }
    }
    for (const auto& [tile, blocks] : tiles) {
      map_.mutable_free_space().Add({std::get<0>(tile), std::get<1>(tile), std::get<2>(tile)}, blocks, 1);
    }
  }

  Map map_{SceneInfo()};
  std::vector<SolidDistance> solids_;
  std::vector<SubmapId> ids_;
  std::vector<Place> hidden_, seen_free_;
};

inline constexpr RelationKind kOn = RelationKind::kOn, kIn = RelationKind::kIn, kNextTo = RelationKind::kNextTo;

/// Kind, subject, object.
using ToldRelations = std::set<std::tuple<RelationKind, SubmapId, SubmapId>>;

inline std::vector<Relation> FindIn(Map& map, std::shared_ptr<const MapSurfaces>& surfaces,
                                    const RelationQuestion& question = {}) {
  SurfaceCache cache(std::size_t{1} << 30);
  surfaces = cache.Of(map.Publish(0));
  return FindRelations(*surfaces, question);
}

inline ToldRelations ToldOf(Map& map, const RelationQuestion& question = {}) {
  std::shared_ptr<const MapSurfaces> surfaces;
  ToldRelations told;
  for (const Relation& relation : FindIn(map, surfaces, question)) {
    EXPECT_TRUE(told.emplace(relation.kind, relation.subject->id(), relation.object->id()).second) << "told once";
  }
  return told;
}

}  // namespace dhpmap::testing
