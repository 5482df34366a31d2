// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/watch/watch_position.h"

#include <charconv>
#include <limits>

#include "server/app/states/etag.h"

namespace dhpmap {

std::string PositionText(const WatchPosition& position) {
  return HistoryText(position.history_id) + "-" + std::to_string(position.revision);
}

std::optional<WatchPosition> ParsePosition(std::string_view text) {
  constexpr std::size_t kHistoryDigits = 16;
  if (text.size() < kHistoryDigits + 2 || text[kHistoryDigits] != '-') return std::nullopt;
  WatchPosition position;
  const char* const dash = text.data() + kHistoryDigits;
  const char* const end = text.data() + text.size();
  const auto history = std::from_chars(text.data(), dash, position.history_id, 16);
  const auto revision = std::from_chars(dash + 1, end, position.revision);
  const bool is_good = history.ec == std::errc() && history.ptr == dash && revision.ec == std::errc() &&
                       revision.ptr == end && position.revision >= 0 &&
                       position.revision < std::numeric_limits<std::int64_t>::max();
  return is_good ? std::optional(position) : std::nullopt;
}

Status HistoryIsLost(const MapInfo& map) {
  return OutOfRange("the position is of another history of map '" + map.name +
                    "', or of a state that was lost: list the map again, and watch from there")
      .WithReason("HISTORY_LOST")
      .WithMetadata("history_id", HistoryText(map.history_id));
}

Result<std::optional<WatchPosition>> PositionBefore(const WatchStart& start, const MapInfo& map,
                                                    const LostRevisions& lost) {
  if (start.history_id && *start.history_id != map.history_id) return HistoryIsLost(map);
  if (start.revision == 0) return std::optional<WatchPosition>();
  const std::int64_t known = start.revision - 1;
  if (known > map.revision || IsLost(lost, known)) return HistoryIsLost(map);
  return std::optional(WatchPosition{map.history_id, known});
}

}  // namespace dhpmap
