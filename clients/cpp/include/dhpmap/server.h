// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace dhpmap::client {

/// A stream of frames that goes into a map.
struct ActiveFeed {
  std::string map, session;                      ///< session: empty for streams that name none
  double silent_s = 0;                           ///< since its last message
  std::int64_t num_frames = 0, num_refused = 0;  ///< fused, and refused, since the map was opened
  double frames_per_s = 0;                       ///< over the last 10 s
};

/// How a server is.
struct ServerStatus {
  using Time = std::chrono::system_clock::time_point;

  std::string version;
  bool is_ready = false;  ///< as its /readyz says
  Time time, start_time;  ///< by its clock: as it answered, and as it began
  std::int64_t database_bytes = 0;
  std::int64_t disk_free_bytes = -1, disk_total_bytes = -1;  ///< where the database is; -1: not known
  double behind_s = 0;                                       ///< age of the oldest frame that is fused and not stored
  double max_behind_s = 0;                                   ///< beyond it frames are refused
  std::vector<ActiveFeed> feeds;
};

}  // namespace dhpmap::client
