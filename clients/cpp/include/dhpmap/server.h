// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace dhpmap::client {

/// A stream of frames into a map.
struct ActiveFeed {
  std::string map, session;                      ///< session: empty for streams without one
  double silent_s = 0;                           ///< since its last message
  std::int64_t num_frames = 0, num_refused = 0;  ///< fused and refused, since the map was opened
  double frames_per_s = 0;                       ///< over the last 10 s
  std::int64_t num_implausible = 0;              ///< frames with a warning, fused or refused
  std::string last_fault, last_warning;          ///< "POSE_INVERTED" and a message; empty: there was no warning
  std::int64_t num_plausible_since = 0;          ///< frames after the last warning
};

/// The status of a server.
struct ServerStatus {
  using Time = std::chrono::system_clock::time_point;

  std::string version;
  bool is_ready = false;  ///< as /readyz reports
  Time time, start_time;  ///< by its clock: time of the answer, and of its start
  std::int64_t database_bytes = 0;
  std::int64_t disk_free_bytes = -1, disk_total_bytes = -1;  ///< of the database's disk; -1: unknown
  double behind_s = 0;                                       ///< age of the oldest fused frame that is not stored
  double max_behind_s = 0;                                   ///< above it frames are refused
  std::vector<ActiveFeed> feeds;
};

}  // namespace dhpmap::client
