// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// MapInfo::history_id as shown to clients: 16 hexadecimal digits.
std::string HistoryText(std::uint64_t history_id);

/// Permanently unique for a state of a submap: the map's history, the submap, the revision of its last change and that
/// of its last edit.
std::string EtagOf(const SubmapInfo& submap, const MapInfo& map);
inline std::string EtagOf(const Submap& submap, const MapInfo& map) { return EtagOf(submap.info(), map); }
/// Identifies the editable state of a map itself. Frames do not change it.
std::string EtagOf(const MapInfo& map);

/// ABORTED, with the present etag, if `given` is neither empty nor the present one. `what`: "submap 7".
Status CheckEtag(std::string_view given, const std::string& present, const std::string& what);
/// For an edit of a submap: ABORTED if the etag is of another submap or history, from before its last edit or merge, or
/// of a lost state. Later changes by frames and refinement are ignored.
Status CheckEtag(std::string_view given, const SubmapInfo& submap, const MapInfo& map, const LostRevisions& lost = {});

/// Preconditions of an edit.
struct EditConditions {
  std::string etag = {};               ///< of the edited object; empty: any
  std::int64_t expected_revision = 0;  ///< no later edit or merge of it; 0: no condition
  LostRevisions lost = {};             ///< lost revisions of the map, which neither may refer to
};

/// OUT_OF_RANGE, reason HISTORY_LOST, for a lost expected revision; ABORTED, reason EDITED_SINCE, for one that the map
/// has not reached.
Status CheckExpectedRevision(const EditConditions& conditions, const MapInfo& map);
/// ABORTED, reason EDITED_SINCE, if `what` ("submap 7") was edited in a revision after the expected one.
Status CheckNotEditedSince(std::int64_t expected_revision, std::int64_t edited_revision, const std::string& what);

/// OUT_OF_RANGE, reason HISTORY_LOST, if the revision in the request's `field` was visible and never stored.
Status CheckNotLost(std::int64_t revision, const LostRevisions& lost, const MapInfo& map, const std::string& field);

}  // namespace dhpmap
