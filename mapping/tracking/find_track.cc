// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/find_track.h"

namespace dhpmap {

const Submap* FindTrack(const Map& map, const std::string& session, std::uint32_t track_id) {
  const Submap* of_any = nullptr;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.sightings.IsTrackedAs(session, track_id)) return submap.get();
    if (of_any == nullptr && info.track_id == track_id && !info.sightings.HasTrack()) of_any = submap.get();
  }
  return of_any;
}

}  // namespace dhpmap
