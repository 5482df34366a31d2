// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/nearest_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

#include "mapping/base/vector_clones.h"
#include "mapping/geometry/surface_rim.h"
#include "mapping/surfaces/look_into_cell.h"

namespace dhpmap {
namespace {

/// Rounding of a tile's float coordinates relative to its width: about ten units in the last place.
constexpr double kCoordinateRounding = 2e-6;

/// The weight of a triangle for the side of points to which `point` of it is nearest: its angle there (Baerentzen and
/// Aanaes, Signed distance computation using the angle weighted pseudonormal, 2005).
float AngleAt(const TriangleCorners& triangle, const Eigen::Vector3f& point) {
  constexpr float kHalfTurn = 3.14159265f;  // on an edge shared by two triangles; inside, any value works
  for (std::size_t i = 0; i < 3; ++i) {
    if (point != triangle[i]) continue;
    const Eigen::Vector3f u = triangle[(i + 1) % 3] - point, v = triangle[(i + 2) % 3] - point;
    return std::atan2(u.cross(v).norm(), u.dot(v));
  }
  return kHalfTurn;
}

Eigen::Vector3f NormalOf(const TriangleCorners& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
}

/// Rounding reduces float distances between points of one cell by no more than this factor.
constexpr float kRounding = 1 - 1e-5f;

}  // namespace

NearestSearch::NearestSearch(const MapSurfaces& surfaces, const std::vector<bool>& is_held,
                             const std::vector<bool>& is_there)
    : surfaces_(surfaces),
      is_held_(is_held),
      is_there_(is_there),
      rounding_m_(static_cast<float>(kCoordinateRounding * kTileSide * kBlockSide *
                                     surfaces.state().info().config.voxel_size_m)) {
  touches_.reserve(8);
}

/// (d + r)^2, where r is the rounding of coordinates, plus 1e-5: near a surface r dominates.
float NearestSearch::WithRounding(float distance2) const {
  return distance2 * (1 + 2e-5f) + (2 * std::sqrt(distance2) + rounding_m_) * rounding_m_;
}

void NearestSearch::Begin(const Eigen::Vector3d& p_map, double limit_m) {
  p_map_ = p_map;
  best2_ = static_cast<float>(limit_m * limit_m);
  limit2_ = WithRounding(best2_);
  touches_.clear();
}

NearestSurface NearestSearch::Find(const Eigen::Vector3d& p_map, double limit_m) {
  Start(p_map, limit_m);
  while (!Step()) {
  }
  return Found();
}

NearestSurface NearestSearch::FindOf(std::size_t number, const Eigen::Vector3d& p_map, double limit_m) {
  stops_at_any_ = false;
  limit_m_ = limit_m;
  cell_ = nullptr;
  Begin(p_map, limit_m);
  scopes_.clear();
  heap_.clear();
  OpenSubmap(static_cast<std::uint32_t>(number), 0);
  VisitPending([&](const Tile& tile) { SearchTile(tile); });
  return Found();
}

bool NearestSearch::IsAnyWithin(const Eigen::Vector3d& p_map, double limit_m) {
  Start(p_map, limit_m);
  stops_at_any_ = true;
  while (!Step()) {
  }
  return !touches_.empty();
}

void NearestSearch::Start(const Eigen::Vector3d& p_map, double limit_m) {
  stops_at_any_ = false;
  limit_m_ = limit_m;
  Begin(p_map, limit_m);
  cell_ = nullptr;
  slot_ = surfaces_.cells().SlotAt(p_map);
  __builtin_prefetch(slot_);
  stage_ = Stage::kSlot;
}

bool NearestSearch::Step() {
  switch (stage_) {
    case Stage::kSlot: {
      bool is_wanted = false;
      if (slot_ != nullptr) {
        std::uintptr_t num_asked = 0;
        cell_ = surfaces_.cells().Find(*slot_, num_asked);
        if (cell_ == nullptr && num_asked == 0) {
          cell_ = surfaces_.cells().TakeOver(LookOf(surfaces_), *slot_, p_map_);
        }
        is_wanted = cell_ == nullptr && num_asked == surfaces_.cells().num_enough();
      }
      if (is_wanted) cell_ = &MakeCell();
      if (cell_ == nullptr) {
        SearchMap();
        stage_ = Stage::kDone;
      } else {
        __builtin_prefetch(cell_);
        __builtin_prefetch(reinterpret_cast<const char*>(cell_) + 64);
        stage_ = Stage::kCell;
      }
      break;
    }
    case Stage::kCell: EnterCell(); break;
    case Stage::kTiles: GoToNextTile(); break;
    case Stage::kTile:
      if (VisitNode()) GoToNextTile();
      break;
    case Stage::kDone: break;
  }
  return stage_ == Stage::kDone;
}

void NearestSearch::EnterCell() {
  way_m_ = static_cast<float>((p_map_ - cell_->centre_m).norm());
  next_tile_ = 0;
  if (surfaces_.cells().IsMarkDue(*cell_)) {
    for (const NearbyTile& tile : cell_->tiles) surfaces_.surface(tile.number).MarkUsed(tile.tile);
  }
  if (!cell_->tiles.empty()) __builtin_prefetch(cell_->tiles.data());
  stage_ = Stage::kTiles;
}

void NearestSearch::GoToNextTile() {
  if (stops_at_any_ && !touches_.empty()) {
    stage_ = Stage::kDone;
    return;
  }
  for (; next_tile_ < cell_->tiles.size(); ++next_tile_) {
    const NearbyTile& next = cell_->tiles[next_tile_];
    const float least_m = kRounding * next.distance_m - way_m_;
    if (least_m > 0 && least_m * least_m > limit2_) break;
    if (!Holds(next.number)) continue;
    const SubmapIndex::Entry& entry = surfaces_.index().entries()[next.number];
    const Eigen::Vector3f p = (entry.ToSubmap(p_map_) - next.corner_m).cast<float>();
    if (next.box.squaredExteriorDistance(p) > limit2_) continue;
    ++next_tile_;
    EnterTile({.triangles = next.triangles, .number = next.number, .tile = next.tile, .p = p});
    stage_ = Stage::kTile;
    return;
  }
  LeaveCell();
}

/// All tiles of the cell were searched: checks whether others may be nearer.
void NearestSearch::LeaveCell() {
  const float seen_m = kRounding * cell_->complete_m - way_m_;
  if (!(seen_m > 0 && limit2_ <= seen_m * seen_m)) {
    Begin(p_map_, touches_.empty() ? limit_m_ : std::sqrt(static_cast<double>(limit2_)));
    SearchMap();
  }
  stage_ = Stage::kDone;
}

/// The surface nearest to a point of the cell is no farther from the centre than the surface nearest to the centre,
/// plus twice the distance between the two points.
const NearbyCell& NearestSearch::MakeCell() {
  const NearbyCells& cells = surfaces_.cells();
  const Eigen::Vector3d p_map = p_map_, centre_m = cells.CentreAt(p_map);
  const double across_m = 2 * cells.radius_m();
  const bool stops_at_any = std::exchange(stops_at_any_, false);
  Begin(centre_m, NearbyCells::kReach_m + across_m);
  sees_all_ = true;
  auto cell = std::make_unique<NearbyCell>();
  VisitTiles([&](const Tile& tile) {
    const float before2 = best2_;
    SearchTile(tile);
    if (touches_.empty()) return;
    touches_.clear();
    const double distance_m = std::sqrt(static_cast<double>(best2_));
    cell->tiles.push_back({.triangles = tile.triangles,
                           .number = tile.number,
                           .tile = tile.tile,
                           .distance_m = static_cast<float>(distance_m),
                           .corner_m = surfaces_.surface(tile.number).Corner(tile.tile),
                           .box = tile.triangles->bounds()});
    best2_ = std::min(before2, static_cast<float>((distance_m + across_m) * (distance_m + across_m)));
    limit2_ = WithRounding(best2_);
  });
  sees_all_ = false;
  cell->complete_m = std::sqrt(best2_);
  std::erase_if(cell->tiles, [&](const NearbyTile& tile) { return tile.distance_m > cell->complete_m; });
  std::sort(cell->tiles.begin(), cell->tiles.end(),
            [](const NearbyTile& a, const NearbyTile& b) { return a.distance_m < b.distance_m; });
  cell->tiles.shrink_to_fit();
  cell->centre_m = centre_m;
  cell->sight = LookIntoCell(surfaces_, cells.BlockAt(p_map));
  stops_at_any_ = stops_at_any;
  Begin(p_map, limit_m_);
  return cells.Put(*slot_, std::move(cell));
}

void NearestSearch::SearchMap() {
  VisitTiles([&](const Tile& tile) {
    SearchTile(tile);
    if (stops_at_any_ && !touches_.empty()) heap_.clear();
  });
}

template <typename Visitor>
void NearestSearch::VisitTiles(Visitor&& visit) {
  scopes_.clear();
  heap_.clear();
  const SubmapIndex& index = surfaces_.index();
  if (index.tree().empty()) return;
  scopes_.push_back({.tree = &index.tree(), .submap = nullptr, .p = index.InTree(p_map_), .number = 0});
  Push({0, 0, 0, index.tree().height()});
  VisitPending(visit);
}

template <typename Visitor>
void NearestSearch::VisitPending(Visitor&& visit) {
  const SubmapIndex& index = surfaces_.index();
  while (!heap_.empty()) {
    const Pending here = Pop();
    if (here.distance2 > limit2_) return;  // and so are all others
    if (here.height > 0) {
      PushChildren(here);
      continue;
    }
    const Scope& from = scopes_[here.scope];
    if (from.submap == nullptr) {
      const std::uint32_t number = index.tree().items()[here.node];
      if (Holds(number)) OpenSubmap(number, here.distance2);
      continue;
    }
    const SubmapIndex::Entry& entry = index.entries()[from.number];
    const TriangleTree& triangles = surfaces_.Triangles(from.number, here.node);
    if (triangles.num_triangles() == 0) continue;
    visit(Tile{.triangles = &triangles,
               .number = from.number,
               .tile = here.node,
               .p = from.submap->InTile(entry.ToSubmap(p_map_), here.node)});
  }
}

void NearestSearch::Push(const Pending& pending) {
  heap_.push_back(pending);
  std::push_heap(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return a.distance2 > b.distance2; });
}

NearestSearch::Pending NearestSearch::Pop() {
  std::pop_heap(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return a.distance2 > b.distance2; });
  const Pending top = heap_.back();
  heap_.pop_back();
  return top;
}

void NearestSearch::PushChildren(const Pending& node) {
  const Scope& scope = scopes_[node.scope];
  float distance2[BoxTree::kLanes];
  unsigned near = scope.tree->ChildrenWithin(node.height, node.node, scope.p, limit2_, distance2);
  for (; near != 0; near &= near - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
    Push(
        {distance2[lane], node.scope, static_cast<std::uint32_t>(BoxTree::kLanes) * node.node + lane, node.height - 1});
  }
}

/// Continues with its tiles.
void NearestSearch::OpenSubmap(std::uint32_t number, float least2) {
  const SubmapIndex::Entry& entry = surfaces_.index().entries()[number];
  const Eigen::Vector3d p_submap = entry.ToSubmap(p_map_);
  const auto distance2 = static_cast<float>(entry.box_m().squaredExteriorDistance(p_submap));
  const SubmapSurface& surface = surfaces_.surface(number);
  if (distance2 > limit2_ || surface.tree().empty()) return;
  scopes_.push_back({.tree = &surface.tree(), .submap = &surface, .p = surface.InTree(p_submap), .number = number});
  Push({std::max(distance2, least2), static_cast<std::uint32_t>(scopes_.size() - 1), 0, surface.tree().height()});
}

void NearestSearch::EnterTile(const Tile& tile) {
  tile_ = tile;
  const BoxTree& tree = tile.triangles->tree();
  tree.Prefetch(tree.height(), 0);
  nodes_[0] = {0, 0, tree.height()};
  num_nodes_ = 1;
}

void NearestSearch::SearchTile(const Tile& tile) {
  EnterTile(tile);
  while (!VisitNode()) {
  }
}

DHPMAP_VECTOR_CLONES
bool NearestSearch::VisitNode() {
  constexpr auto kLanes = static_cast<std::uint32_t>(BoxTree::kLanes);
  const BoxTree& tree = tile_.triangles->tree();
  float distance2[kLanes];
  const Node here = nodes_[--num_nodes_];
  if (here.height > 0) {
    unsigned near = tree.ChildrenWithin(here.height, here.node, tile_.p, limit2_, distance2);
    const std::size_t first = num_nodes_;
    for (; near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      std::size_t at = num_nodes_++;
      for (; at > first && nodes_[at - 1].distance2 < distance2[lane]; --at) nodes_[at] = nodes_[at - 1];
      nodes_[at] = {distance2[lane], kLanes * here.node + lane, here.height - 1};
    }
  } else {
    unsigned near = tile_.triangles->packet(here.node).Within(tile_.p, limit2_, distance2);
    for (; near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      if (distance2[lane] > limit2_ || !IsThere(kLanes * here.node + lane)) continue;
      const float as_near2 = WithRounding(distance2[lane]);
      if (as_near2 < best2_) touches_.clear();
      touches_.push_back({tile_, kLanes * here.node + lane});
      if (stops_at_any_) return true;
      if (distance2[lane] >= best2_) continue;
      best2_ = distance2[lane];
      limit2_ = as_near2;
    }
  }
  while (num_nodes_ > 0 && nodes_[num_nodes_ - 1].distance2 > limit2_) --num_nodes_;
  if (num_nodes_ == 0) return true;
  const Node& next = nodes_[num_nodes_ - 1];
  if (next.height > 0) {
    tree.Prefetch(next.height, next.node);
  } else {
    tile_.triangles->PrefetchPacket(next.node);
  }
  return false;
}

NearestSurface NearestSearch::Found() {
  NearestSurface found;
  found.sight = cell_ == nullptr ? nullptr : &cell_->sight;
  float most2 = std::numeric_limits<float>::infinity();
  if (touches_.size() > 1) {
    // Sort, so that the result at a seam does not depend on the order of discovery.
    std::sort(touches_.begin(), touches_.end(), [](const Touch& a, const Touch& b) {
      return std::tie(a.tile.number, a.tile.tile, a.position) < std::tie(b.tile.number, b.tile.tile, b.position);
    });
    // Measured again, with different rounding: the nearest result is the reference, so that at least one qualifies.
    float nearest2 = std::numeric_limits<float>::infinity();
    for (const Touch& touch : touches_) {
      const Eigen::Vector3f point = NearestPointOf(touch.tile.triangles->triangle(touch.position), touch.tile.p);
      nearest2 = std::min(nearest2, (touch.tile.p - point).squaredNorm());
    }
    most2 = std::max(limit2_, WithRounding(nearest2));
  }
  float side = 0, least2 = std::numeric_limits<float>::infinity();
  const Touch* nearest = nullptr;
  for (const Touch& touch : touches_) {
    const TriangleCorners triangle = touch.tile.triangles->triangle(touch.position);
    const Eigen::Vector3f point = NearestPointOf(triangle, touch.tile.p), away = touch.tile.p - point;
    const float distance2 = away.squaredNorm();
    if (distance2 > most2) continue;  // qualified only for an earlier minimum
    const Eigen::Vector3f normal = NormalOf(triangle);
    // A single triangle needs no weight.
    side += touches_.size() == 1 ? normal.dot(away) : AngleAt(triangle, point) * normal.dot(away);
    if (distance2 >= least2) continue;
    least2 = distance2;
    nearest = &touch;
    found.is_any = true;
    found.number = touch.tile.number;
    found.p_submap = surfaces_.index().entries()[found.number].ToSubmap(p_map_);
    found.point_submap = surfaces_.surface(found.number).FromTile(point, touch.tile.tile);
    found.normal_submap = normal.cast<double>();
  }
  found.is_behind = side < 0;
  found.is_beside = (found.is_behind || tells_all_beside_) && nearest != nullptr && IsBeside(*nearest);
  return found;
}

bool NearestSearch::IsBeside(const Touch& nearest) {
  const TriangleCorners triangle = nearest.tile.triangles->triangle(nearest.position);
  const Eigen::Vector3f point = NearestPointOf(triangle, nearest.tile.p), away = nearest.tile.p - point;
  const float distance_m = away.norm(), same_m = 4 * rounding_m_;
  // Straight above or below the face it does not matter whether the surface ends there; nor on the surface.
  constexpr float kAcross = 0.9998f;  // cosine of about one degree
  if (distance_m <= same_m || std::abs(NormalOf(triangle).dot(away)) >= kAcross * distance_m) return false;
  const std::span<const SubmapIndex::Entry> entries = surfaces_.index().entries();
  const Eigen::Vector3d point_submap = surfaces_.surface(nearest.tile.number).FromTile(point, nearest.tile.tile);
  // On the map's grid the surface continues in neighbouring submaps.
  const auto goes_on_in = [&](std::uint32_t number) {
    return number == nearest.tile.number ||
           (entries[number].IsInMapFrame() && entries[nearest.tile.number].IsInMapFrame());
  };
  around_.assign(1, triangle);
  for (Eigen::Vector3f& corner : around_[0]) corner -= point;
  for (const Touch& touch : touches_) {
    const bool is_other = touch.tile.number != nearest.tile.number || touch.tile.tile != nearest.tile.tile ||
                          touch.position != nearest.position;
    if (!goes_on_in(touch.tile.number) || !is_other) continue;
    const Eigen::Vector3f origin = surfaces_.surface(touch.tile.number).InTile(point_submap, touch.tile.tile);
    TriangleCorners& other = around_.emplace_back(touch.tile.triangles->triangle(touch.position));
    for (Eigen::Vector3f& corner : other) corner -= origin;
  }
  return EndsAtOrigin(around_, same_m);
}

}  // namespace dhpmap
