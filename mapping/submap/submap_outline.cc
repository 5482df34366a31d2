// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/submap_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mapping/submap/support_height.h"
#include "mapping/submap/surface_crossings.h"

namespace dhpmap {
namespace {

/// The value that a share of them are not above. Changes their order.
template <typename Number>
Number ShareBelow(std::vector<Number>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// In the submap's frame turned so, without what few frames have seen.
std::vector<SurfaceCrossing> LevelCrossings(const Submap& submap, const Eigen::Matrix3d& R, double least_weight) {
  std::vector<SurfaceCrossing> crossings = FindSurfaceCrossings(submap);
  if (crossings.empty()) return crossings;
  std::vector<float> weights;
  weights.reserve(crossings.size());
  for (const SurfaceCrossing& crossing : crossings) weights.push_back(crossing.weight);
  const double least = least_weight * static_cast<double>(ShareBelow(weights, 0.5));
  std::erase_if(crossings, [least](const SurfaceCrossing& crossing) { return crossing.weight < least; });
  for (SurfaceCrossing& crossing : crossings) {
    crossing.p_m = R * crossing.p_m;
    crossing.normal = R * crossing.normal;
  }
  return crossings;
}

/// How far a surface reaches along an axis of length 1.
struct Reach {
  double low_m = 0, high_m = 0;
};

class Surface {
 public:
  Surface(std::vector<SurfaceCrossing> crossings, double voxel_size_m, const OutlineRules& rules)
      : crossings_(std::move(crossings)), voxel_size_m_(voxel_size_m), rules_(rules) {}

  [[nodiscard]] Reach Along(const Eigen::Vector3d& axis) const { return {-HighestAlong(-axis), HighestAlong(axis)}; }

  /// From above, of what is within a rectangle.
  [[nodiscard]] ConvexOutline Hull(const Rectangle* within = nullptr) const {
    const auto is_in = [within](const Eigen::Vector2d& p) {
      if (within == nullptr) return true;
      const Eigen::Vector2d away = p - within->center, &across = within->across;
      return std::abs(across.dot(away)) <= within->size.x() / 2 &&
             std::abs(across.x() * away.y() - across.y() * away.x()) <= within->size.y() / 2;
    };
    std::vector<Eigen::Vector2d> points;
    points.reserve(crossings_.size());
    for (const SurfaceCrossing& crossing : crossings_) {
      if (is_in(crossing.p_m.head<2>())) points.emplace_back(crossing.p_m.head<2>());
    }
    return ConvexHull(std::move(points));
  }

  /// Along the sides of the least rectangle (rotating callipers) around what is left without strays.
  [[nodiscard]] Rectangle LeastAround() const {
    Rectangle least = LeastRectangle(Hull());
    for (int round = 0; round < 2; ++round) {
      least = Around(least.across);
      if (const ConvexOutline hull = Hull(&least); hull.size() > 1) least.across = LeastRectangle(hull).across;
    }
    return Ordered(Around(least.across));
  }

  /// The hull and half a voxel around it, within the box.
  [[nodiscard]] ConvexOutline Footprint(const UprightBox& box) const {
    const ConvexOutline sides = FootprintOf(box);
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& corner : Hull()) {
      for (const Eigen::Vector2d& side : sides) {
        const Eigen::Vector2d away = side - box.center_m.head<2>();
        points.push_back(corner + voxel_size_m_ / 2 * away.normalized());
      }
    }
    const ConvexOutline footprint = Intersection(ConvexHull(std::move(points)), sides);
    return footprint.empty() ? sides : footprint;
  }

  [[nodiscard]] const std::vector<SurfaceCrossing>& crossings() const { return crossings_; }
  /// With its sides along an axis of length 1 and across.
  [[nodiscard]] Rectangle Around(const Eigen::Vector2d& across) const {
    const Eigen::Vector2d aside(-across.y(), across.x());
    const Reach first = Along({across.x(), across.y(), 0}), second = Along({aside.x(), aside.y(), 0});
    return {(first.low_m + first.high_m) / 2 * across + (second.low_m + second.high_m) / 2 * aside,
            across,
            {first.high_m - first.low_m, second.high_m - second.low_m}};
  }

 private:
  /// Around each crossing is a disc of surface. Of these, all but a few strays are below a height; of what is within a
  /// voxel of that, a part is above the side.
  [[nodiscard]] double HighestAlong(const Eigen::Vector3d& axis) const {
    const double radius_m = rules_.disc_vox * voxel_size_m_;
    std::vector<double> tops_m;
    tops_m.reserve(crossings_.size());
    for (const SurfaceCrossing& crossing : crossings_) {
      const double steep = crossing.normal.dot(axis);
      tops_m.push_back(crossing.p_m.dot(axis) + radius_m * std::sqrt(std::max(0.0, 1 - steep * steep)));
    }
    const double limit_m = ShareBelow(tops_m, 1 - rules_.stray_share);
    std::erase_if(tops_m, [&](double top_m) { return top_m > limit_m || top_m < limit_m - voxel_size_m_; });
    return ShareBelow(tops_m, 1 - rules_.layer_share);
  }

  const std::vector<SurfaceCrossing> crossings_;
  const double voxel_size_m_;
  const OutlineRules& rules_;
};

}  // namespace

Eigen::Matrix3d LevellingOf(const Transform& T_map_submap) {
  constexpr double kRounding = 1e-9;
  const Eigen::Vector3d up = T_map_submap.linear().row(2);
  if (up.z() > 0 && up.head<2>().norm() < kRounding) return Eigen::Matrix3d::Identity();
  const auto turn = [&up](const Eigen::Vector3d& to) {
    return Eigen::Quaterniond::FromTwoVectors(up, to).toRotationMatrix();
  };
  constexpr double kUpsideDown = -0.6;  // the shortest turn to z is no function of up near -z; nothing rests at 127 deg
  if (up.z() > kUpsideDown) return turn(Eigen::Vector3d::UnitZ());
  return Eigen::Vector3d(1, -1, -1).asDiagonal() * turn(-Eigen::Vector3d::UnitZ());
}

std::optional<SubmapOutline> FindOutline(const Submap& submap, const Eigen::Matrix3d& R_level_submap,
                                         const OutlineRules& rules) {
  const double voxel_size_m = submap.info().voxel_size_m;
  const Surface surface(LevelCrossings(submap, R_level_submap, rules.least_weight), voxel_size_m, rules);
  if (surface.crossings().empty()) return std::nullopt;
  const Rectangle rectangle = surface.LeastAround();
  const Reach up = surface.Along(Eigen::Vector3d::UnitZ());
  SubmapOutline outline;
  outline.box = BoxOn(rectangle, up.low_m, up.high_m);
  outline.footprint_m = surface.Footprint(outline.box);
  outline.support_height_m = SupportHeight(surface.crossings(), voxel_size_m, AreaOf(outline.footprint_m));
  return outline;
}

SubmapOutline Moved(const SubmapOutline& outline, const Transform& T_there_here) {
  SubmapOutline moved = outline;
  moved.box.center_m = T_there_here * outline.box.center_m;
  moved.box.yaw_rad =
      std::remainder(outline.box.yaw_rad + std::atan2(T_there_here(1, 0), T_there_here(0, 0)), std::numbers::pi);
  for (Eigen::Vector2d& corner : moved.footprint_m) {
    corner = (T_there_here * Eigen::Vector3d(corner.x(), corner.y(), 0)).head<2>().eval();
  }
  if (moved.support_height_m) *moved.support_height_m += T_there_here.translation().z();
  return moved;
}

std::optional<SubmapOutline> OutlineInMap(const Submap& submap, const OutlineRules& rules) {
  return OutlineAt(submap.info().T_map_submap, submap, rules);
}

std::optional<SubmapOutline> OutlineAt(const Transform& T_map_submap, const Submap& submap, const OutlineRules& rules) {
  const Eigen::Matrix3d R_level_submap = LevellingOf(T_map_submap);
  const auto outline = FindOutline(submap, R_level_submap, rules);
  if (!outline) return std::nullopt;
  return Moved(*outline, T_map_submap * Transform(Eigen::Matrix3d(R_level_submap.transpose())));
}

std::shared_ptr<const LevelOutline> FindLevelOutline(const Submap& submap) {
  const Transform& T_map_submap = submap.info().T_map_submap;
  if (auto kept = submap.kept_outline().Find(T_map_submap)) return kept;
  auto found = std::make_shared<const LevelOutline>(
      LevelOutline{.up = T_map_submap.linear().row(2), .outline = FindOutline(submap, LevellingOf(T_map_submap))});
  submap.kept_outline().Keep(found);
  return found;
}

Eigen::AlignedBox3d BoxAround(const SubmapOutline& outline) {
  const double half_m = outline.box.size_m.z() / 2, middle_m = outline.box.center_m.z();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector2d& corner : outline.footprint_m) {
    box.extend(Eigen::Vector3d(corner.x(), corner.y(), middle_m - half_m));
    box.extend(Eigen::Vector3d(corner.x(), corner.y(), middle_m + half_m));
  }
  return box;
}

}  // namespace dhpmap
