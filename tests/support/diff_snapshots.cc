// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/diff_snapshots.h"

namespace dhpmap {

std::vector<SubmapChange> DiffSnapshots(const MapSnapshot* before, const MapSnapshot& after) {
  std::vector<SubmapChange> changes;
  for (const auto& submap : after.submaps()) {
    const Submap* old = before ? before->Find(submap->id()) : nullptr;
    if (old == nullptr || old->part_id() != submap->part_id()) changes.push_back(DiffSubmap(old, *submap));
  }
  if (before == nullptr) return changes;
  for (const auto& old : before->submaps()) {
    if (after.Find(old->id()) == nullptr) changes.push_back({.id = old->id()});
  }
  return changes;
}

std::vector<SubmapChange> DiffSnapshots(const StateMarks& before, const MapSnapshot& after) {
  std::vector<SubmapChange> changes;
  for (const auto& submap : after.submaps()) {
    const SubmapMarks* old = before.Find(submap->id());
    if (old == nullptr || !old->IsOf(submap)) changes.push_back(DiffSubmap(old, *submap));
  }
  for (const auto& [id, old] : before.submaps()) {
    if (after.Find(id) == nullptr) changes.push_back({.id = id});
  }
  return changes;
}

}  // namespace dhpmap
