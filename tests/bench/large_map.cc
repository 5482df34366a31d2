// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/large_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "mapping/map/history_id.h"
#include "mapping/map/map.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"

namespace dhpmap::bench {
namespace {

constexpr double kLargeVoxel_m = 0.05, kLargeTruncation_m = 0.15;
constexpr int kRoomsARow = 16, kRoomsATime = 16;
constexpr double kWall_m = 0.8;  ///< of a wall's surface from the border of its room
constexpr ClassId kFloorClass{1}, kWallClass{2}, kBallClass{3};
constexpr SubmapId kFloorSubmap{1}, kWallSubmap{2};

std::uint64_t MixBits(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9u;
  word = (word ^ (word >> 27)) * 0x94D049BB133111EBu;
  return word ^ (word >> 31);
}

/// The same for a voxel of a class wherever it is asked for.
std::uint64_t NoiseOf(VoxelIndex v, ClassId c) {
  std::uint64_t noise = c.value;
  for (const std::int32_t axis : {v.x, v.y, v.z}) {
    noise = MixBits(noise + 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(axis));
  }
  return noise;
}

/// With three bits of the noise, from `shift` on.
std::uint8_t Shade(int base, std::uint64_t noise, int shift) {
  return static_cast<std::uint8_t>(base + static_cast<int>(noise >> shift & 7u));
}

/// The voxels of one block that are within the truncation. Returns how many.
template <typename Distance>
std::uint64_t WriteBlockOf(const Distance& distance_m, BlockIndex index, ClassId c, Submap& submap) {
  constexpr double kNoiseStep_m = 2e-5;  // 256 of them: 5 mm
  TsdfBlock* tsdf = nullptr;
  LabelBlock* labels = nullptr;
  std::uint64_t num_observations = 0;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    const VoxelIndex voxel = VoxelIn(index, linear);
    const double exact_m = distance_m(VoxelCentre(voxel, kLargeVoxel_m));
    if (std::abs(exact_m) > kLargeTruncation_m - 256 * kNoiseStep_m) continue;
    if (tsdf == nullptr) {
      tsdf = &submap.MutableTsdf(index);
      labels = &submap.MutableLabels(index);
    }
    const std::uint64_t noise = NoiseOf(voxel, c);
    const auto i = static_cast<std::size_t>(linear);
    tsdf->distance_m[i] = static_cast<float>(exact_m + kNoiseStep_m * (static_cast<double>(noise & 255u) - 127.5));
    tsdf->weight[i] = 5.0f + static_cast<float>(noise >> 8 & 15u);
    tsdf->color[i] = {Shade(90, noise, 12), Shade(120, noise, 15), Shade(60, noise, 18)};
    const std::uint64_t seen = 1 + (noise >> 21 & 3u);
    for (std::uint64_t n = 0; n < seen; ++n) labels->AddObservation(linear, c);
    num_observations += seen;
  }
  return num_observations;
}

/// What of a surface lies in a box. `distance_m`: of a point of the map frame, grows by no more than 1.2 m a metre.
template <typename Distance>
void WriteSurface(const Distance& distance_m, const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m, ClassId c,
                  Submap& submap) {
  constexpr double kBlock_m = kLargeVoxel_m * kBlockSide;
  const Eigen::Vector3d inside_m = Eigen::Vector3d::Constant(kLargeVoxel_m / 2);
  const BlockIndex low = BlockOf(VoxelAt(low_m + inside_m, kLargeVoxel_m));
  const BlockIndex high = BlockOf(VoxelAt(high_m - inside_m, kLargeVoxel_m));
  std::uint64_t num_observations = 0;
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const Eigen::Vector3d middle_m = (Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5)) * kBlock_m;
        if (std::abs(distance_m(middle_m)) > kLargeTruncation_m + 1.2 * kBlock_m) continue;
        num_observations += WriteBlockOf(distance_m, {x, y, z}, c, submap);
      }
    }
  }
  submap.AddClassObservations(c, num_observations);
}

Submap& AddLargeSubmap(Panoptic panoptic, ClassId c, Map& map) {
  SubmapInfo info;
  info.panoptic = panoptic;
  info.class_id = c;
  info.voxel_size_m = kLargeVoxel_m;
  info.truncation_m = kLargeTruncation_m;
  info.activity = Activity::kInactive;
  info.num_frames_observed = 10;
  return map.Create(std::move(info));
}

void AddRoom(int room, Map& map) {
  const Eigen::Vector3d low_m = RoomOrigin_m(room);
  const Eigen::Vector3d high_m = low_m + Eigen::Vector3d(kRoomSide_m, kRoomSide_m, kRoomHeight_m);
  const auto to_floor = [](const Eigen::Vector3d& p) {
    return p.z() - kFloorHeight_m - 0.04 * std::sin(1.3 * p.x()) * std::cos(0.9 * p.y());
  };
  const auto to_walls = [&](const Eigen::Vector3d& p) {
    const double x_m = p.x() - low_m.x() - kWall_m - 0.02 * std::sin(2.1 * p.y() + p.z());
    const double y_m = p.y() - low_m.y() - kWall_m - 0.02 * std::cos(1.7 * p.x() + p.z());
    return std::min(x_m, y_m);
  };
  WriteSurface(to_floor, low_m, high_m, kFloorClass, *map.FindMutable(kFloorSubmap));
  WriteSurface(to_walls, low_m, high_m, kWallClass, *map.FindMutable(kWallSubmap));
  for (int n = 0; n < 4; ++n) {
    const double radius_m = 0.3 + 0.05 * static_cast<double>((room + n) % 5);
    const Eigen::Vector3d center_m =
        low_m + Eigen::Vector3d(2.4 + 2.4 * (n % 2), 2.4 + 2.4 * (n / 2), kFloorHeight_m + radius_m + 0.1);
    const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(radius_m + kLargeTruncation_m);
    Submap& ball = AddLargeSubmap(Panoptic::kThing, kBallClass, map);
    WriteSurface([&](const Eigen::Vector3d& p) { return (p - center_m).norm() - radius_m; }, center_m - reach_m,
                 center_m + reach_m, kBallClass, ball);
    ball.UpdateBoundingSphere();
  }
}

/// What is there already stays on the disk.
Status AddRooms(int first, int end, MapStore& store) {
  DHPMAP_ASSIGN_OR_RETURN(auto state, store.LoadMap(kLargeMapName));
  Map map(std::move(state));
  const StateMarks before(*map.published());
  for (int room = first; room < end; ++room) AddRoom(room, map);
  for (const SubmapId id : {kFloorSubmap, kWallSubmap}) map.FindMutable(id)->UpdateBoundingSphere();
  return store.Commit(before, *map.Publish(1 + end), Durability::kNormal);
}

Status BeginLargeMap(MapStore& store) {
  MapInfo info;
  info.name = kLargeMapName;
  info.history_id = DrawHistoryId();
  info.config.voxel_size_m = kLargeVoxel_m;
  info.config.truncation_m = kLargeTruncation_m;
  DHPMAP_ASSIGN_OR_RETURN(LabelSet labels,
                          LabelSet::Create({{.id = kFloorClass, .name = "floor", .panoptic = Panoptic::kStuff},
                                            {.id = kWallClass, .name = "wall", .panoptic = Panoptic::kStuff},
                                            {.id = kBallClass, .name = "ball"}}));
  info.label_set = std::make_shared<LabelSet>(std::move(labels));
  Map map(std::move(info));
  AddLargeSubmap(Panoptic::kStuff, kFloorClass, map);
  AddLargeSubmap(Panoptic::kStuff, kWallClass, map);
  return store.CreateMap(*map.Publish(1));
}

}  // namespace

Eigen::Vector3d RoomOrigin_m(int room) {
  const int row = room / kRoomsARow, along = room % kRoomsARow;
  const int column = row % 2 == 0 ? along : kRoomsARow - 1 - along;
  return {kRoomSide_m * column, kRoomSide_m * row, 0};
}

Result<LargeMap> MakeLargeMap(const std::string& database_path, double disk_mib) {
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore(database_path, {.pages_tiles = true}));
  DHPMAP_RETURN_IF_ERROR(BeginLargeMap(*store));
  LargeMap made;
  while (static_cast<double>(made.blob_bytes) < disk_mib * (1 << 20)) {
    DHPMAP_RETURN_IF_ERROR(AddRooms(made.num_rooms, made.num_rooms + kRoomsATime, *store));
    made.num_rooms += kRoomsATime;
    DHPMAP_ASSIGN_OR_RETURN(const StoredMap stored, store->GetMap(kLargeMapName));
    made.num_submaps = stored.num_submaps;
    made.num_tsdf_blocks = stored.num_tsdf_blocks;
    made.num_label_blocks = stored.num_label_blocks;
    made.blob_bytes = stored.blob_bytes;
  }
  return made;
}

}  // namespace dhpmap::bench
