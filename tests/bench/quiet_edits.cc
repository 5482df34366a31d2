// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/quiet_edits.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "mapping/query/distance_query.h"
#include "tests/bench/cpu_time.h"

namespace dhpmap::bench {
void MeasureQuietEdits(const std::shared_ptr<const MapSnapshot>& map, SurfaceCache& cache, std::mt19937& random) {
  const Submap *named = nullptr, *moved = nullptr;
  for (const auto& submap : map->submaps()) {
    if (submap->info().panoptic != Panoptic::kThing || submap->blocks().empty()) continue;
    if (named == nullptr) named = submap.get();
    const auto way_m = [&](const Submap& other) {
      return (other.BoundingSphereInMap().center_m - named->BoundingSphereInMap().center_m).norm();
    };
    if (moved == nullptr || way_m(*submap) > way_m(*moved)) moved = submap.get();
  }
  if (named == nullptr) return;
  std::uniform_real_distribution<double> unit(-1.5, 1.5);
  std::vector<Eigen::Vector3d> points(10000);
  for (Eigen::Vector3d& p : points) {
    p = named->BoundingSphereInMap().center_m + Eigen::Vector3d{unit(random), unit(random), unit(random)};
  }
  double sum_m = 0;
  const auto ask = [&](const std::shared_ptr<const MapSurfaces>& surfaces) {
    const DistanceQuery query(surfaces, {});
    return CpuOf_s([&] {
      for (const Eigen::Vector3d& p : points) sum_m += query.At(p).distance_m;
    });
  };
  double steady_s = 1;
  for (int n = 0; n < 10; ++n) steady_s = std::min(steady_s, ask(cache.Of(map)));
  Map next(map);
  const auto after = [&](const char* what) {
    const auto state = next.Publish(1);
    std::shared_ptr<const MapSurfaces> surfaces;
    const double made_s = CpuOf_s([&] { surfaces = cache.Of(state); });
    const double first_s = ask(surfaces);
    std::printf("after %-24s the state %.2f ms, its first 10,000 distances %.1f ms, before %.1f\n", what, 1e3 * made_s,
                1e3 * first_s, 1e3 * steady_s);
    for (int n = 0; n < 10; ++n) (void)ask(surfaces);
  };
  next.FindMutable(named->id())->mutable_info().display_name = "renamed";
  after("a thing was renamed:");
  next.FindMutable(moved->id())->mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0.1, 0.1, 0));
  after("a move far away:");
  std::printf("  (%.0f m)\n", sum_m);
}

}  // namespace dhpmap::bench
