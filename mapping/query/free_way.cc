// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/free_way.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mapping/query/ray_query.h"

namespace dhpmap {
namespace {

constexpr double kTouching_vox = 1;      // nothing fits into such a gap
constexpr double kEnds_vox = 0.5;        // at each end of a way; may be unobserved
constexpr double kMostUnseen_vox = 1.5;  // consecutive, in the rest of a way: less than a wall
constexpr std::size_t kMostWays = 256;   // candidates to try

struct Way {
  Eigen::Vector3d from_m, to_m;
  double length_m;
};

std::vector<Way> WaysTo(const RelatedThing& thing, const RelatedBody& body, double most_m, OneSurface& surface,
                        const std::stop_token& stop) {
  std::vector<Way> ways;
  for (const Eigen::Vector3d& p : thing.points_m) {
    if (stop.stop_requested()) return {};
    if (body.box_m.exteriorDistance(p) > most_m) continue;
    const auto found = surface.Nearest(body.number, thing.body.number, p, most_m);
    if (found) ways.push_back({p, found->point_m, found->distance_m});
  }
  std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.length_m < b.length_m; });
  if (ways.size() <= kMostWays) return ways;
  std::vector<Way> chosen;
  chosen.reserve(kMostWays);
  for (std::size_t i = 0; i < kMostWays; ++i) chosen.push_back(ways[i * ways.size() / kMostWays]);
  return chosen;
}

bool IsBlocked(const Way& way, std::span<const RelatedBody* const> others, const QueryWorld& world,
               const Transform& T_map_query) {
  const Eigen::AlignedBox3d box(way.from_m.cwiseMin(way.to_m), way.from_m.cwiseMax(way.to_m));
  const Ray ray{T_map_query * way.from_m, T_map_query.linear() * (way.to_m - way.from_m).normalized()};
  return std::any_of(others.begin(), others.end(), [&](const RelatedBody* body) {
    return body->box_m.intersects(box) && MeetsSubmap(world.surfaces(), body->number, ray, way.length_m);
  });
}

bool IsSeen(const Way& way, const QueryWorld& world, const Transform& T_map_query) {
  if (world.surfaces().state().free_space()->tiles().empty()) return true;  // free space is not recorded in this map
  const double voxel_m = world.voxel_size_m(), step_m = voxel_m / 2;
  const Eigen::Vector3d direction = (way.to_m - way.from_m).normalized();
  double unseen_m = 0;  // length of the current unobserved part
  for (double at_m = kEnds_vox * voxel_m; at_m <= way.length_m - kEnds_vox * voxel_m; at_m += step_m) {
    const bool is_seen = world.SightAt(T_map_query * (way.from_m + at_m * direction), {}).is_front;
    unseen_m = is_seen ? 0 : unseen_m + step_m;
    if (unseen_m > kMostUnseen_vox * voxel_m) return false;
  }
  return true;
}

}  // namespace

std::optional<double> FreeWay(const RelatedThing& thing, const RelatedBody& body,
                              std::span<const RelatedBody* const> others, double most_m, const QueryWorld& world,
                              OneSurface& surface, const std::stop_token& stop) {
  for (const Way& way : WaysTo(thing, body, most_m, surface, stop)) {
    if (stop.stop_requested()) return std::nullopt;
    if (way.length_m <= kTouching_vox * thing.voxel_m()) return way.length_m;
    if (IsSeen(way, world, surface.T_map_query()) && !IsBlocked(way, others, world, surface.T_map_query())) {
      return way.length_m;
    }
  }
  return std::nullopt;
}

}  // namespace dhpmap
