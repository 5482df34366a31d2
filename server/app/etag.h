// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mapping/map/map.h"

namespace dhpmap {

/// MapInfo::history_id as clients see it: 16 hexadecimal digits.
std::string HistoryText(std::uint64_t history_id);

/// Identifies a state of a submap for ever: the map's history, and the revision that last changed it.
std::string EtagOf(const SubmapInfo& submap, const MapInfo& map);
inline std::string EtagOf(const Submap& submap, const MapInfo& map) { return EtagOf(submap.info(), map); }
/// Identifies what an edit can change of a map itself. Does not change with frames.
std::string EtagOf(const MapInfo& map);

/// ABORTED, telling the present etag, if one is given that is another. `what`: "submap 7".
Status CheckEtag(std::string_view given, const std::string& present, const std::string& what);

}  // namespace dhpmap
