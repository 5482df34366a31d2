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

/// One session of frames of a map: how far it has got, and what has come of its frames since the map was opened.
struct SessionStatus {
  std::string session;      ///< empty: streams without one
  bool is_feeding = false;  ///< a stream of it has its place
  /// While it feeds: s until it makes place for others if nothing comes; 0: it does.
  double lease_left_s = 0;
  std::optional<std::int64_t> accepted_sequence;  ///< of the last frame that was taken; not of a stream without a name
  std::optional<std::int64_t> stored_sequence;    ///< of the last one that is in the store
  FeedCounts counts;
  SensorPath path;  ///< of frames fused since the map was opened
};

/// The sessions that the map knows, those that feed it and those that were heard of since it was opened, by name.
/// `stored`: the sequence of a feed, or of a session that has none (null), that is in the store. `now_ns`: UTC.
std::vector<SessionStatus> ListSessions(
    const FeedSeats& seats, const SessionMarks& marks,
    const std::function<std::optional<std::int64_t>(const std::string& session, Feed* feed)>& stored,
    std::int64_t now_ns);

}  // namespace dhpmap
