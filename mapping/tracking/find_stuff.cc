// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/find_stuff.h"

namespace dhpmap {

const Submap* FindStuff(const Map& map, ClassId class_id) {
  const Submap* seen_as = nullptr;
  const Submap* relabelled = nullptr;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic != Panoptic::kStuff || info.is_placed || !info.IsSeenAs(class_id)) continue;
    if (!info.class_is_fixed) return submap.get();
    const Submap*& first = info.class_id != class_id ? seen_as : relabelled;
    if (first == nullptr) first = submap.get();
  }
  return seen_as != nullptr ? seen_as : relabelled;
}

}  // namespace dhpmap
