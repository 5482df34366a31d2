// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/gone_causes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "mapping/base/grid.h"
#include "mapping/voxels/gone_block.h"

namespace dhpmap::bench {
namespace {

/// The most that any corner of the surface's cell counts, of the voxels of all submaps that show it.
int MostLooks(const MapSnapshot& map, const Eigen::Vector3d& surface_m) {
  const double size_m = map.info().config.voxel_size_m;
  const VoxelIndex low = VoxelAt(surface_m - Eigen::Vector3d::Constant(0.5 * size_m), size_m);
  int most = 0;
  for (const auto& submap : map.submaps()) {
    for (int i = 0; i < 8; ++i) {
      const VoxelIndex corner{low.x + (i & 1), low.y + (i >> 1 & 1), low.z + (i >> 2)};
      const BlockEntry* entry = submap->blocks().Find(BlockOf(corner));
      if (entry == nullptr || entry->tsdf == nullptr || entry->gone == nullptr) continue;
      if (entry->Shows(LinearIndex(corner))) most = std::max(most, entry->gone->Count(LinearIndex(corner)));
    }
  }
  return most;
}

/// What is said of a point, in words.
struct GoneCause {
  std::array<const char*, 3> words;
};

const char* HolderOf(const SubmapInfo& info, std::int64_t second_walk_ns) {
  if (info.panoptic == Panoptic::kUnknown) return "held by the unknown submap";
  if (info.panoptic != Panoptic::kThing) return "held by the background";
  return info.last_observed_ns < second_walk_ns ? "held by a thing that the second walk has not seen"
                                                : "held by a thing that the second walk has seen";
}

GoneCause CauseOf(const MapSnapshot& after, const SecondWalk& walk, const GonePoint& point,
                  const SurfaceDistance& nearest) {
  constexpr double kBehind_vox = 1.5;  // as GoneLook has it
  constexpr std::array<const char*, 4> kLooks = {"counted never", "counted once", "counted twice", "counted thrice"};
  const MapConfig& config = after.info().config;
  const int num_past = walk.CountPast(point.p_map_m, kBehind_vox * config.voxel_size_m, config.integration.max_range_m);
  const char* looked = num_past == 0  ? "never looked through"
                       : num_past < 3 ? "looked through once or twice"
                                      : "looked through more often";
  return {{looked, HolderOf(*nearest.submap, walk.first_stamp_ns()),
           kLooks[static_cast<std::size_t>(MostLooks(after, nearest.nearest_m))]}};
}

}  // namespace

int SecondWalk::CountPast(const Eigen::Vector3d& p_map_m, double behind_m, double max_range_m) const {
  int num = 0;
  for (const View& view : views_) {
    const PinholeCamera& camera = view.data.camera;
    const Eigen::Vector3d p = view.T_sensor_map * p_map_m;
    if (p.z() < 0.2 || p.norm() + behind_m > max_range_m) continue;
    const double u = std::round(camera.fx_px * p.x() / p.z() + camera.cx_px);
    const double v = std::round(camera.fy_px * p.y() / p.z() + camera.cy_px);
    if (!(u >= 0 && v >= 0 && u < camera.width_px && v < camera.height_px)) continue;
    const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px);
    num += view.data.depth_m[pixel + static_cast<std::size_t>(u)] > p.z() * (1 + behind_m / p.norm());
  }
  return num;
}

void PrintGoneCauses(const MapSnapshot& after, const SecondWalk& walk, const std::vector<GonePoint>& points,
                     const std::vector<SurfaceDistance>& nearest, std::size_t num_asked) {
  std::array<std::map<std::string, int>, 3> counts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const GoneCause cause = CauseOf(after, walk, points[i], nearest[i]);
    for (std::size_t k = 0; k < counts.size(); ++k) ++counts[k][cause.words[k]];
  }
  for (const auto& of_kind : counts) {
    for (const auto& [words, count] : of_kind) {
      std::printf("    of these %-48s %5.2f %%\n", words.c_str(), 100.0 * count / static_cast<double>(num_asked));
    }
  }
}

}  // namespace dhpmap::bench
