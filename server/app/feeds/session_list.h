// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mapping/map/session_marks.h"
#include "server/app/feeds/feed_seats.h"

namespace dhpmap {

/// A feed session of a map: its progress, and its statistics since the map was opened.
struct SessionStatus {
  std::string session;      ///< empty: streams without a name
  bool is_feeding = false;  ///< has an active stream
  /// While active: seconds of silence until it may be replaced; 0: now.
  double lease_left_s = 0;
  std::optional<std::int64_t> accepted_sequence;  ///< of the last accepted frame; none for streams without a name
  std::optional<std::int64_t> stored_sequence;    ///< of the last stored frame
  FeedCounts counts;
  SensorPath path;  ///< of frames fused since the map was opened
};

/// Known, active and recent sessions of the map, by name. `stored`: returns the stored sequence of a feed, or of a
/// session without one (null). `now_ns`: UTC.
std::vector<SessionStatus> ListSessions(
    const FeedSeats& seats, const SessionMarks& marks,
    const std::function<std::optional<std::int64_t>(const std::string& session, Feed* feed)>& stored,
    std::int64_t now_ns);

}  // namespace dhpmap
