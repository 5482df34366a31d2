// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/free_space_finder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mapping/map/free_space.h"
#include "mapping/space/camera_view.h"
#include "mapping/space/lidar_view.h"
#include "mapping/space/tile_look.h"

namespace dhpmap {
namespace {

constexpr int kTileVoxels = SideOf(CellSize::kTile);  // along an edge

// Tiles are looked at in parts of so many, so that what they are found to be takes some 1 MB.
constexpr std::size_t kTilesAPart = 256;

/// A tile that may have something free, its centre relative to the sensor.
struct TileToLook {
  TileIndex index;
  CellSight sight;
  float x, y, z;
};

struct Found {
  FreeBlocks blocks;
  bool is_news = false;
};

/// The sensor on the map's grid, its origin split so that single precision holds it anywhere.
struct GridOrigin {
  VoxelIndex voxel;            ///< that holds it
  Eigen::Vector3d offset_vox;  ///< within that voxel

  GridOrigin(const Eigen::Vector3d& p_map_m, double voxel_size_m)
      : voxel(VoxelAt(p_map_m, voxel_size_m)),
        offset_vox(p_map_m / voxel_size_m - Eigen::Vector3d(voxel.x, voxel.y, voxel.z)) {}

  /// From the sensor to the centre of a tile, along one axis.
  static float ToCentre(std::int32_t tile, std::int32_t origin, double offset_vox) {
    const auto first = static_cast<double>(std::int64_t{tile} * kTileVoxels - origin);
    return static_cast<float>(first + 0.5 * kTileVoxels - offset_vox);
  }
};

/// The tiles along one axis that a range of voxels from the sensor touches.
struct TileRange {
  std::int32_t first = 0, last = -1;
  TileRange(double least_vox, double most_vox, std::int32_t origin, double offset_vox) {
    constexpr double kReach = kMaxSight_vox;
    // Written so that NaN, of a camera of absurd focal length, is the limit.
    const double least = least_vox > -kReach ? least_vox : -kReach, most = most_vox < kReach ? most_vox : kReach;
    if (!(least <= most)) return;
    first = TileOf(origin + static_cast<std::int32_t>(std::floor(least + offset_vox)));
    last = TileOf(origin + static_cast<std::int32_t>(std::floor(most + offset_vox)));
  }
  static std::int32_t TileOf(std::int32_t voxel) { return voxel >> (kBlockSideLog2 + kTileSideLog2); }
};

/// Tests all tiles of the box, eight at a time, and lists those that are not hidden.
template <typename View>
void ListTiles(const View& view, const GridOrigin& origin, std::vector<TileToLook>& tiles) {
  tiles.clear();
  const Box box = view.Reach();
  if (!(box.least_vox.array() <= box.most_vox.array()).any()) return;
  const auto range = [&](int axis, std::int32_t voxel) {
    return TileRange(box.least_vox[axis], box.most_vox[axis], voxel, origin.offset_vox[axis]);
  };
  const TileRange xs = range(0, origin.voxel.x), ys = range(1, origin.voxel.y), zs = range(2, origin.voxel.z);
  CellBatch batch;
  batch.size = CellSize::kTile;
  std::array<TileIndex, kLanes> indices;
  std::size_t num_in_batch = 0;
  const auto flush = [&] {
    CellSights sights;
    view.Classify(batch, sights);
    for (std::size_t i = 0; i < num_in_batch; ++i) {
      if (sights[i] == CellSight::kHidden) continue;
      tiles.push_back({indices[i], sights[i], batch.x[i], batch.y[i], batch.z[i]});
    }
    num_in_batch = 0;
  };
  for (std::int32_t z = zs.first; z <= zs.last; ++z) {
    for (std::int32_t y = ys.first; y <= ys.last; ++y) {
      for (std::int32_t x = xs.first; x <= xs.last; ++x) {
        indices[num_in_batch] = {x, y, z};
        batch.x[num_in_batch] = GridOrigin::ToCentre(x, origin.voxel.x, origin.offset_vox.x());
        batch.y[num_in_batch] = GridOrigin::ToCentre(y, origin.voxel.y, origin.offset_vox.y());
        batch.z[num_in_batch] = GridOrigin::ToCentre(z, origin.voxel.z, origin.offset_vox.z());
        if (++num_in_batch == kLanes) flush();
      }
    }
  }
  flush();
}

}  // namespace

struct FreeSpaceFinder::Scratch {
  CameraView camera;
  LidarView lidar;
  std::vector<TileToLook> tiles;
  std::vector<Found> found;

  template <typename View>
  void LookThrough(const View& view, const GridOrigin& origin, std::int64_t stamp_ns, Map& map, ThreadPool& pool);
  /// What one tile has that the map does not.
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
void FreeSpaceFinder::Scratch::LookThrough(const View& view, const GridOrigin& origin, std::int64_t stamp_ns, Map& map,
                                           ThreadPool& pool) {
  ListTiles(view, origin, tiles);
  found.resize(std::min(kTilesAPart, tiles.size()));
  for (std::size_t begin = 0; begin < tiles.size(); begin += kTilesAPart) {
    const std::size_t count = std::min(kTilesAPart, tiles.size() - begin);
    const FreeSpace& known = map.free_space();
    pool.ParallelFor(count, [&](std::size_t i) { LookAtTile(view, tiles[begin + i], known, stamp_ns, found[i]); });
    for (std::size_t i = 0; i < count; ++i) {
      if (found[i].is_news) map.mutable_free_space().Add(tiles[begin + i].index, found[i].blocks, stamp_ns);
    }
  }
}

FreeSpaceFinder::FreeSpaceFinder() = default;
FreeSpaceFinder::~FreeSpaceFinder() = default;
FreeSpaceFinder::FreeSpaceFinder(FreeSpaceFinder&&) noexcept = default;
FreeSpaceFinder& FreeSpaceFinder::operator=(FreeSpaceFinder&&) noexcept = default;

void FreeSpaceFinder::Look(const PanopticFrame& frame, Map& map, ThreadPool& pool) {
  if (scratch_ == nullptr) scratch_ = std::make_unique<Scratch>();
  const MapConfig& config = map.info().config;
  const double voxel_size_m = config.voxel_size_m;
  const LookOptions options{.voxel_size_m = voxel_size_m,
                            .margin_m = config.truncation_m,
                            .max_range_m = std::min(config.integration.max_range_m, kMaxSight_vox * voxel_size_m)};
  const GridOrigin origin(frame.T_map_sensor.translation(), voxel_size_m);
  const Eigen::Matrix3d R_sensor_grid = frame.T_map_sensor.linear().transpose();
  if (frame.camera) {
    scratch_->camera.Build(*frame.camera, R_sensor_grid, options, pool);
    scratch_->LookThrough(scratch_->camera, origin, frame.stamp_ns, map, pool);
  } else {
    scratch_->lidar.Build(*frame.lidar, R_sensor_grid, options, pool);
    scratch_->LookThrough(scratch_->lidar, origin, frame.stamp_ns, map, pool);
  }
}

}  // namespace dhpmap
