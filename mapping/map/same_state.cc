// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/same_state.h"

#include <tuple>

namespace dhpmap {

bool IsSameState(const MapInfo& a, const MapInfo& b) {
  const auto marks_of = [](const MapInfo& info) {
    return std::tie(info.history_id, info.create_time_ns, info.revision, info.update_time_ns, info.num_frames,
                    info.next_submap_id);
  };
  return marks_of(a) == marks_of(b);
}

}  // namespace dhpmap
