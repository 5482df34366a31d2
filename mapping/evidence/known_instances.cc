// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/known_instances.h"

#include "mapping/map/map_grid.h"

namespace dhpmap {

KnownInstances::KnownInstances(std::span<const SubmapId> ids, const Map& map) {
  for (const SubmapId id : ids) {
    const Submap* submap = map.Find(id);
    if (submap != nullptr && IsExclusive(submap->info(), map.info().config)) ids_.push_back(id);
  }
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
}

SubmapId KnownInstances::MostSeen(SubmapId holder, const LabelBlock& labels, int linear) const {
  SubmapCount most;
  Visit(holder, labels, linear, [&most](SubmapCount seen) {
    if (seen.count > most.count || (seen.count == most.count && seen.id < most.id)) most = seen;
  });
  return most.count > 0 ? most.id : holder;
}

}  // namespace dhpmap
