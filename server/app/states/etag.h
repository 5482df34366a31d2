// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// MapInfo::history_id as clients see it: 16 hexadecimal digits.
std::string HistoryText(std::uint64_t history_id);

/// Identifies a state of a submap for ever, and of no other submap: the map's history, the submap, the revision that
/// last changed it and that of its last edit.
std::string EtagOf(const SubmapInfo& submap, const MapInfo& map);
inline std::string EtagOf(const Submap& submap, const MapInfo& map) { return EtagOf(submap.info(), map); }
/// Identifies what an edit can change of a map itself. Does not change with frames.
std::string EtagOf(const MapInfo& map);

/// ABORTED, telling the present etag, if one is given that is another. `what`: "submap 7".
Status CheckEtag(std::string_view given, const std::string& present, const std::string& what);
/// Of an edit of a submap: the same if the etag given is of another submap or history, of before its last edit or
/// merge, or of a state that was lost. What frames and refinement have changed since does not matter.
Status CheckEtag(std::string_view given, const SubmapInfo& submap, const MapInfo& map, const LostRevisions& lost = {});

/// What the state that an edit meets must be, or it is not made.
struct EditConditions {
  std::string etag = {};               ///< of what is edited; empty: whatever it is
  std::int64_t expected_revision = 0;  ///< no edit or merge of it may be later; 0: whatever was done
  LostRevisions lost = {};             ///< what the map has not in its past: neither may be of it
};

/// OUT_OF_RANGE, reason HISTORY_LOST, for a revision expected that was lost; ABORTED, reason EDITED_SINCE, for one that
/// the map has not reached.
Status CheckExpectedRevision(const EditConditions& conditions, const MapInfo& map);
/// ABORTED, reason EDITED_SINCE, if `what` ("submap 7") was edited in a revision after the expected one.
Status CheckNotEditedSince(std::int64_t expected_revision, std::int64_t edited_revision, const std::string& what);

/// OUT_OF_RANGE, reason HISTORY_LOST, if a revision that a request gives in `field` was seen and is not stored.
Status CheckNotLost(std::int64_t revision, const LostRevisions& lost, const MapInfo& map, const std::string& field);

}  // namespace dhpmap
