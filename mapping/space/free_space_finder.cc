// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/free_space_finder.h"

#include <algorithm>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/stopped.h"
#include "mapping/free/free_space.h"
#include "mapping/space/camera_view.h"
#include "mapping/space/gone_finder.h"
#include "mapping/space/lidar_view.h"
#include "mapping/space/look_options.h"
#include "mapping/space/look_tiles.h"
#include "mapping/space/tile_look.h"

namespace dhpmap {
namespace {

// Tiles are processed in parts of this many, whose results take about 1 MB.
constexpr std::size_t kTilesAPart = 256;

struct alignas(kCacheLineBytes) Found {
  FreeBlocks blocks;
  bool is_news = false;
};

}  // namespace

struct FreeSpaceFinder::Scratch {
  CameraView camera;
  LidarView lidar;
  std::vector<TileToLook> tiles;
  std::vector<Found> found;
  GoneFinder gone;

  template <typename View>
  std::vector<SubmapId> Look(const View& view, const PanopticFrame& frame, Map& map, ThreadPool& pool,
                             const std::stop_token& stop);
  template <typename View>
  void AddFree(const View& view, std::int64_t stamp_ns, Map& map, ThreadPool& pool, const std::stop_token& stop);
  /// The free voxels of one tile that the map does not have yet.
  template <typename View>
  void LookAtTile(const View& view, const TileToLook& tile, const FreeSpace& known, std::int64_t stamp_ns,
                  Found& result) const;
};

template <typename View>
void FreeSpaceFinder::Scratch::LookAtTile(const View& view, const TileToLook& tile, const FreeSpace& known,
                                          std::int64_t stamp_ns, Found& result) const {
  const FreeTile* before = known.Find(tile.index);
  const bool is_stale = before != nullptr && FreeSpace::IsStale(*before, stamp_ns);
  result.is_news = false;
  if (before != nullptr && !is_stale && ~before->full() == 0) return;
  TileLook<View>(view, before, is_stale, result.blocks).Look(tile.sight, tile.x, tile.y, tile.z);
  if (result.blocks.empty()) return;
  result.is_news = before == nullptr || is_stale || !before->Holds(result.blocks);
}

template <typename View>
std::vector<SubmapId> FreeSpaceFinder::Scratch::Look(const View& view, const PanopticFrame& frame, Map& map,
                                                     ThreadPool& pool, const std::stop_token& stop) {
  const Eigen::Vector3d eye_m = frame.T_map_sensor.translation();
  const GridOrigin origin(eye_m, map.info().config.voxel_size_m);
  ListTiles(view, origin, tiles);
  if (map.info().config.space.free) AddFree(view, frame.stamp_ns, map, pool, stop);
  if (!map.info().config.space.gone) return {};
  return gone.Look(view, origin, {eye_m, frame.stamp_ns}, map, pool, stop);
}

template <typename View>
void FreeSpaceFinder::Scratch::AddFree(const View& view, std::int64_t stamp_ns, Map& map, ThreadPool& pool,
                                       const std::stop_token& stop) {
  found.resize(std::min(kTilesAPart, tiles.size()));
  for (std::size_t begin = 0; begin < tiles.size(); begin += kTilesAPart) {
    const std::size_t count = std::min(kTilesAPart, tiles.size() - begin);
    const FreeSpace& known = map.free_space();
    pool.ParallelFor(count, [&](std::size_t i) {
      ThrowIfStopped(stop);
      LookAtTile(view, tiles[begin + i], known, stamp_ns, found[i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (found[i].is_news) map.mutable_free_space().Add(tiles[begin + i].index, found[i].blocks, stamp_ns);
    }
  }
}

FreeSpaceFinder::FreeSpaceFinder() = default;
FreeSpaceFinder::~FreeSpaceFinder() = default;
FreeSpaceFinder::FreeSpaceFinder(FreeSpaceFinder&&) noexcept = default;
FreeSpaceFinder& FreeSpaceFinder::operator=(FreeSpaceFinder&&) noexcept = default;

std::vector<SubmapId> FreeSpaceFinder::Look(const PanopticFrame& frame, Map& map, ThreadPool& pool,
                                            const std::stop_token& stop) {
  if (scratch_ == nullptr) scratch_ = std::make_unique<Scratch>();
  const MapConfig& config = map.info().config;
  const double voxel_size_m = config.voxel_size_m;
  const LookOptions options{.voxel_size_m = voxel_size_m,
                            .margin_m = config.truncation_m,
                            .max_range_m = std::min(config.integration.max_range_m, kMaxSight_vox * voxel_size_m)};
  const Eigen::Matrix3d R_sensor_grid = frame.T_map_sensor.linear().transpose();
  if (frame.camera) {
    scratch_->camera.Build(*frame.camera, R_sensor_grid, options, pool);
    return scratch_->Look(scratch_->camera, frame, map, pool, stop);
  }
  scratch_->lidar.Build(*frame.lidar, R_sensor_grid, options, pool);
  return scratch_->Look(scratch_->lidar, frame, map, pool, stop);
}

}  // namespace dhpmap
