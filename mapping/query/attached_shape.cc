// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/attached_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

namespace dhpmap {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// A ball around the corners, and so around the triangles.
AttachedShape::Ball BallAround(const std::vector<Corners>& triangles) {
  Eigen::AlignedBox3d box;
  for (const Corners& t : triangles) {
    for (const Eigen::Vector3d& corner : t) box.extend(corner);
  }
  double radius2 = 0;
  for (const Corners& t : triangles) {
    for (const Eigen::Vector3d& corner : t) radius2 = std::max(radius2, (corner - box.center()).squaredNorm());
  }
  return {box.center(), std::sqrt(radius2)};
}

AttachedShape::Ball BallAround(const std::vector<AttachedShape::Ball>& balls) {
  Eigen::AlignedBox3d box;
  for (const AttachedShape::Ball& ball : balls) box.extend(ball.center_m);
  double radius_m = 0;
  for (const AttachedShape::Ball& ball : balls) {
    radius_m = std::max(radius_m, (ball.center_m - box.center()).norm() + ball.radius_m);
  }
  return {box.center(), radius_m};
}

/// Whether any of its blocks has look-through counts.
bool IsLookedThrough(const Submap& submap) {
  for (const BlockEntry& block : submap.blocks().entries()) {
    if (block.gone != nullptr) return true;
  }
  return false;
}

}  // namespace

namespace {

/// Makes a body from triangles in any order.
class BodyMaker {
 public:
  BodyMaker(double voxel_size_m, std::size_t max_balls) : size_m_(voxel_size_m), max_balls_(max_balls) {}

  [[nodiscard]] bool is_full() const { return body_.num_balls > max_balls_; }
  void Add(const TriangleTree& triangles, std::size_t position, const SubmapSurface& surface, std::size_t tile) {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = surface.FromTile(triangles.triangle(position)[k], tile);
    // A triangle of marching cubes lies in one cell, whose corners are voxel centres.
    const VoxelIndex cell = VoxelAt((t[0] + t[1] + t[2]) / 3 - Eigen::Vector3d::Constant(0.5 * size_m_), size_m_);
    auto& of_cell = cells_[BlockOf(cell)][cell];
    body_.num_balls += of_cell.empty() ? 1 : 0;
    of_cell.push_back(t);
  }
  void AddAll(const MapSnapshot& state, const Submap& submap, const SubmapSurface& surface) {
    for (std::size_t tile = 0; tile < surface.num_tiles() && !is_full(); ++tile) {
      const TriangleTree& triangles = surface.Surface(state, submap, tile);
      for (std::size_t i = 0; i < triangles.num_triangles(); ++i) {
        if (triangles.NeededBy(i).empty()) Add(triangles, i, surface, tile);
      }
    }
  }
  AttachedShape Make() {
    for (const auto& [block, of_block] : cells_) {
      AttachedShape::Group& group = body_.groups.emplace_back();
      for (const auto& [cell, triangles] : of_block) group.balls.push_back(BallAround(triangles));
      group.around = BallAround(group.balls);
      body_.reach_m = std::max(body_.reach_m, group.around.center_m.norm() + group.around.radius_m);
    }
    return std::move(body_);
  }

 private:
  const double size_m_;
  const std::size_t max_balls_;
  std::map<BlockIndex, std::map<VoxelIndex, std::vector<Corners>>> cells_;
  AttachedShape body_;
};

}  // namespace

AttachedShape AttachedShapeOf(const MapSnapshot& state, const Submap& submap, const SubmapSurface& surface,
                              std::size_t max_balls) {
  BodyMaker maker(submap.info().voxel_size_m, max_balls);
  maker.AddAll(state, submap, surface);
  return maker.Make();
}

AttachedShape WholeBodyOf(const MapSurfaces& surfaces, SubmapId id, std::size_t max_balls) {
  const Submap* submap = surfaces.state().Find(id);
  if (submap == nullptr) return {};
  const SubmapSurface* known = surfaces.SurfaceOf(id).get();
  if (!IsLookedThrough(*submap) && known != nullptr) {
    return AttachedShapeOf(surfaces.state(), *submap, *known, max_balls);
  }
  Submap whole = *submap;
  whole.ShareBlocks();  // before anything writes to them
  whole.DropGone();
  const auto ledger = std::make_shared<SurfaceLedger>();
  const SubmapSurface surface(whole, nullptr, nullptr, [&](std::span<const TilePlace> places) {
    SubmapSurface::Slots slots;
    slots.reserve(places.size());
    for (const TilePlace& place : places) {
      slots.push_back(std::make_shared<const TileSurfaceSlot>(place, whole.info().voxel_size_m, ledger));
    }
    return slots;
  });
  return AttachedShapeOf(surfaces.state(), whole, surface, max_balls);
}

}  // namespace dhpmap
