// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/nearest_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "mapping/query/vector_clones.h"

namespace dhpmap {
namespace {

/// A micrometre or so more than the distance itself, for rounding.
float WithRounding(float distance2) { return distance2 * (1 + 2e-5f) + 1e-9f; }

/// A triangle's say on the side of those to whom `point` of it is nearest: its angle there (Baerentzen and Aanaes,
/// Signed distance computation using the angle weighted pseudonormal, 2005).
float AngleAt(const TriangleCorners& triangle, const Eigen::Vector3f& point) {
  constexpr float kHalfTurn = 3.14159265f;  // on an edge, which two triangles share; inside, any will do
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

}  // namespace

NearestSearch::NearestSearch(const MapSurfaces& surfaces, const std::vector<bool>& is_held)
    : surfaces_(surfaces), is_held_(is_held) {
  scopes_.reserve(64);
  heap_.reserve(256);
  touches_.reserve(16);
}

NearestSurface NearestSearch::Find(const Eigen::Vector3d& p_map, double limit_m) {
  p_map_ = p_map;
  best2_ = static_cast<float>(limit_m * limit_m);
  limit2_ = WithRounding(best2_);
  scopes_.clear();
  heap_.clear();
  touches_.clear();
  const SubmapIndex& index = surfaces_.index();
  OpenTree({.tree = &index.tree(), .triangles = nullptr, .submap = nullptr, .p = index.InTree(p_map)}, 0);
  Run();
  return Describe();
}

void NearestSearch::OpenTree(const Scope& scope, float distance2) {
  if (scope.tree->empty()) return;
  scopes_.push_back(scope);
  Push({distance2, static_cast<std::uint32_t>(scopes_.size() - 1), 0, scope.tree->height()});
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

DHPMAP_VECTOR_CLONES
void NearestSearch::Run() {
  while (!heap_.empty()) {
    Pending here = Pop();
    if (here.distance2 > limit2_) return;  // and so is all that is left
    // Down from here, as long as nothing else may be nearer.
    while (here.distance2 <= limit2_) {
      if (here.height == 0) {
        Open(here);
        break;
      }
      const Scope& scope = scopes_[here.scope];
      float distance2[BoxTree::kLanes];
      unsigned near = scope.tree->ChildrenWithin(here.height, here.node, scope.p, limit2_, distance2);
      const std::uint32_t first = BoxTree::kLanes * here.node;
      if (scope.triangles != nullptr && here.height == 1) {
        const TriangleTree& triangles = *scope.triangles;
        for (; near != 0; near &= near - 1) {
          const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
          if (distance2[lane] <= limit2_) Try(triangles.triangle(first + lane), here.scope);
        }
        break;
      }
      Pending next{limit2_ + 1, 0, 0, 0};
      for (; near != 0; near &= near - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
        const Pending child{distance2[lane], here.scope, first + lane, here.height - 1};
        if (next.distance2 > limit2_) {
          next = child;
        } else if (child.distance2 < next.distance2) {
          Push(next);
          next = child;
        } else {
          Push(child);
        }
      }
      here = next;
      if (!heap_.empty() && heap_.front().distance2 < here.distance2 && here.distance2 <= limit2_) {
        Push(here);
        break;
      }
    }
  }
}

/// Goes from a submap to its tiles, from a tile to its triangles.
void NearestSearch::Open(const Pending& item) {
  const Scope from = scopes_[item.scope];
  if (from.submap == nullptr) {
    const std::uint32_t number = from.tree->items()[item.node];
    if (!is_held_.empty() && !is_held_[number]) return;
    const SubmapIndex::Entry& entry = surfaces_.index().entries()[number];
    const Eigen::Vector3d p_submap = entry.ToSubmap(p_map_);
    const auto distance2 = static_cast<float>(entry.box_m().squaredExteriorDistance(p_submap));
    if (distance2 > limit2_) return;
    const SubmapSurface& surface = surfaces_.surface(number);
    OpenTree({.tree = &surface.tree(),
              .triangles = nullptr,
              .submap = &surface,
              .p = surface.InTree(p_submap),
              .number = number,
              .tile = 0,
              .p_submap = p_submap},
             std::max(distance2, item.distance2));
    return;
  }
  const Submap& submap = surfaces_.index().entries()[from.number].submap();
  const TriangleTree& triangles = from.submap->Surface(submap, item.node);
  const Eigen::Vector3f p = from.submap->InTile(from.p_submap, item.node);
  const float distance2 = triangles.bounds().squaredExteriorDistance(p);
  if (triangles.num_triangles() == 0 || distance2 > limit2_) return;
  OpenTree({.tree = &triangles.tree(),
            .triangles = &triangles,
            .submap = from.submap,
            .p = p,
            .number = from.number,
            .tile = item.node,
            .p_submap = from.p_submap},
           distance2);
}

void NearestSearch::Try(const TriangleCorners& triangle, std::uint32_t scope) {
  const Eigen::Vector3f& p = scopes_[scope].p;
  const float distance2 = (p - NearestPointOf(triangle, p)).squaredNorm();
  if (!(distance2 <= limit2_)) return;  // a triangle without an area may give NaN
  if (WithRounding(distance2) < best2_) touches_.clear();
  touches_.push_back({&triangle, scope});
  if (distance2 >= best2_) return;
  best2_ = distance2;
  limit2_ = WithRounding(distance2);
}

NearestSurface NearestSearch::Describe() const {
  NearestSurface found;
  float side = 0, least2 = std::numeric_limits<float>::infinity();
  for (const Touch& touch : touches_) {
    const Scope& scope = scopes_[touch.scope];
    const Eigen::Vector3f point = NearestPointOf(*touch.triangle, scope.p), away = scope.p - point;
    const float distance2 = away.squaredNorm();
    if (distance2 > limit2_) continue;  // was as near as the nearest of that time
    const Eigen::Vector3f normal = NormalOf(*touch.triangle);
    side += AngleAt(*touch.triangle, point) * normal.dot(away);
    if (distance2 >= least2) continue;
    least2 = distance2;
    found.is_any = true;
    found.number = scope.number;
    found.p_submap = scope.p_submap;
    found.point_submap = scope.submap->FromTile(point, scope.tile);
    found.normal_submap = normal.cast<double>();
  }
  found.is_behind = side < 0;
  return found;
}

}  // namespace dhpmap
