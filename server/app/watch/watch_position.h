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

/// A place in what becomes of a map: everything up to the revision is known.
struct WatchPosition {
  std::uint64_t history_id = 0;
  std::int64_t revision = 0;
  bool operator==(const WatchPosition&) const = default;
};

/// "{history}-{revision}": 16 hexadecimal digits, and decimal ones.
std::string PositionText(const WatchPosition& position);
/// Nothing for what PositionText does not make.
std::optional<WatchPosition> ParsePosition(std::string_view text);

/// Where somebody wants to begin.
struct WatchStart {
  std::int64_t revision = 0;                ///< the first to be told of; 0: from now on
  std::optional<std::uint64_t> history_id;  ///< that the revision is of; none: the present one
};

/// The position before a start of the map; nothing: where it is stored now. OUT_OF_RANGE, reason HISTORY_LOST, for one
/// of another history, of a revision that the map has not reached, or of a state that was lost.
Result<std::optional<WatchPosition>> PositionBefore(const WatchStart& start, const MapInfo& map,
                                                    const LostRevisions& lost);

/// OUT_OF_RANGE.
Status HistoryIsLost(const MapInfo& map);

}  // namespace dhpmap
