// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/enclosure.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "mapping/query/ray_query.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMostPoints = 48;
constexpr double kLeastInBox = 0.5;                     // of the thing's box, within that of the body
constexpr double kLeastBelow = 0.5, kLeastAbove = 0.1;  // of the thing's points
constexpr double kBelowShare = 0.25, kAboveShare = 0.25, kAroundShare = 0.5;
constexpr int kDirections = 8;

double BoxVolume(const Eigen::AlignedBox3d& box) { return box.isEmpty() ? 0 : box.sizes().prod(); }

class Encloser {
 public:
  Encloser(const RelatedBody& body, const QueryWorld& world, const OneSurface& surface)
      : body_(body), world_(world), T_map_query_(surface.T_map_query()) {}

  [[nodiscard]] bool Meets(const Eigen::Vector3d& p_m, const Eigen::Vector3d& direction) const {
    const Ray ray{T_map_query_ * p_m, T_map_query_.linear() * direction};
    return MeetsSubmap(world_.surfaces(), body_.number, ray, body_.box_m.diagonal().norm());
  }
  /// Checks up to the end of the body's box.
  [[nodiscard]] bool IsSeenToLeave(const Eigen::Vector3d& p_m, const Eigen::Vector3d& direction) const {
    const double step_m = world_.voxel_size_m();
    for (Eigen::Vector3d at = p_m + step_m * direction; body_.box_m.contains(at); at += step_m * direction) {
      if (world_.SightAt(T_map_query_ * at, {}).is_front) return true;
    }
    return false;
  }

 private:
  const RelatedBody& body_;
  const QueryWorld& world_;
  const Transform& T_map_query_;
};

}  // namespace

double EnclosureOf(const RelatedThing& thing, const RelatedBody& body, bool is_below, const QueryWorld& world,
                   const OneSurface& surface, const std::stop_token& stop) {
  const double in_box = BoxVolume(thing.body.box_m.intersection(body.box_m));
  if (in_box < kLeastInBox * BoxVolume(thing.body.box_m) || !body.box_m.contains(thing.body.box_m.center())) return 0;
  const Encloser encloser(body, world, surface);
  const std::size_t step = thing.points_m.size() / kMostPoints + 1;
  double num_points = 0, num_below = 0, num_above = 0, num_met = 0, num_closed = 0;
  for (std::size_t i = step / 2; i < thing.points_m.size(); i += step, ++num_points) {
    if (stop.stop_requested()) return 0;
    num_below += is_below || encloser.Meets(thing.points_m[i], -Eigen::Vector3d::UnitZ());
  }
  if (num_below < kLeastBelow * num_points || num_points == 0) return 0;
  for (std::size_t i = step / 2; i < thing.points_m.size(); i += step) {
    if (stop.stop_requested()) return 0;
    num_above += encloser.Meets(thing.points_m[i], Eigen::Vector3d::UnitZ());
    for (int turn = 0; turn < kDirections; ++turn) {
      const double angle = 2 * std::numbers::pi * turn / kDirections;
      const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0);
      const bool is_met = encloser.Meets(thing.points_m[i], direction);
      num_met += is_met;
      num_closed += is_met || !encloser.IsSeenToLeave(thing.points_m[i], direction);
    }
  }
  const bool is_above = num_above >= kLeastAbove * num_points;
  const double around = (is_above ? num_closed : num_met) / (kDirections * num_points);
  return kBelowShare + (is_above ? kAboveShare : 0) + kAroundShare * around;
}

}  // namespace dhpmap
