// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "mapping/base/result.h"

namespace dhpmap::bench {

/// A made map, as large as wanted: rooms in rows of a building, each with a floor and two walls, which belong to two
/// large submaps of stuff, and four balls, each a thing. Noise of the distances, weights and colours makes it pack
/// about as recorded maps do. It has no free space.
inline constexpr char kLargeMapName[] = "large";
inline constexpr double kRoomSide_m = 6.4;    ///< whole tiles: no tile is of two rooms
inline constexpr double kRoomHeight_m = 3.2;  ///< likewise
inline constexpr double kFloorHeight_m = 0.4;

/// The lowest corner of a room. Rows go to and fro, so that a room is beside the one before it.
Eigen::Vector3d RoomOrigin_m(int room);

struct LargeMap {
  int num_rooms = 0;
  std::int64_t num_submaps = 0, num_tsdf_blocks = 0, num_label_blocks = 0;
  std::int64_t blob_bytes = 0;  ///< encoded, as the store counts them
};

/// Makes the map in a new database until its blobs take `disk_mib`. Rooms are added and committed some at a time, and
/// then left on the disk: in memory are never more than 16 rooms (some 0.2 GB) and the directory of tiles.
Result<LargeMap> MakeLargeMap(const std::string& database_path, double disk_mib);

}  // namespace dhpmap::bench
