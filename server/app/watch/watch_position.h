// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mapping/base/result.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// A position in a map's history: everything up to the revision is known.
struct WatchPosition {
  std::uint64_t history_id = 0;
  std::int64_t revision = 0;
  bool operator==(const WatchPosition&) const = default;
};

/// "{history}-{revision}": 16 hexadecimal digits, and decimal ones.
std::string PositionText(const WatchPosition& position);
/// Nothing for a malformed text.
std::optional<WatchPosition> ParsePosition(std::string_view text);

/// Requested start of a watch.
struct WatchStart {
  std::int64_t revision = 0;                ///< the first to report; 0: from now on
  std::optional<std::uint64_t> history_id;  ///< of that revision; none: the present one
};

/// The position before a start; nothing: the stored state. OUT_OF_RANGE, reason HISTORY_LOST, for another history, a
/// revision that the map has not reached, or a lost state.
Result<std::optional<WatchPosition>> PositionBefore(const WatchStart& start, const MapInfo& map,
                                                    const LostRevisions& lost);

/// OUT_OF_RANGE.
Status HistoryIsLost(const MapInfo& map);

}  // namespace dhpmap
