// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/revision_restore.h"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mapping/changes/state_delta.h"
#include "mapping/map/vacated_space.h"
#include "mapping/objects/apply_delta.h"
#include "server/app/edits/edit_undo.h"
#include "server/app/edits/submap_edits.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

Status EditedAfter(const std::string& what, std::int64_t revision, std::int64_t expected) {
  return Aborted(what + " was edited in revision " + std::to_string(revision) + ", after " + std::to_string(expected))
      .WithReason("EDITED_SINCE");
}

Status CheckNotEdited(const Submap& submap, std::int64_t expected) {
  const std::int64_t edited = submap.info().edited_revision;
  if (edited <= expected) return Status::Ok();
  return EditedAfter("submap " + std::to_string(submap.id().value), edited, expected);
}

/// For a removed object: only the log knows what removed it.
Status CheckNotRemovedSince(SubmapId id, std::int64_t expected, MapStore& store, const std::string& map) {
  EditQuery query{.max_edits = 200};
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const auto edits, store.ListEdits(map, query));
    for (const LoggedEdit& edit : edits) {
      const std::vector<SubmapId>& removed = edit.entry.summary.removed;
      if (edit.entry.revision <= expected) return Status::Ok();
      if (std::find(removed.begin(), removed.end(), id) == removed.end()) continue;
      return EditedAfter("submap " + std::to_string(id.value), edit.entry.revision, expected);
    }
    if (edits.size() < query.max_edits) return Status::Ok();
    query.before_revision = edits.back().entry.revision;
  }
}

/// Checks that nothing to be restored was edited since.
Status CheckExpected(const RestoreRequest& request, MapStore& store, const Map& map) {
  const std::int64_t expected = request.expected_revision;
  if (expected == 0) return Status::Ok();
  DHPMAP_RETURN_IF_ERROR(CheckNotLost(expected, request.lost, map.info(), "expected_revision"));
  if (expected > map.info().revision) {
    return Aborted("the map is at revision " + std::to_string(map.info().revision) + ", not yet at " +
                   std::to_string(expected))
        .WithReason("EDITED_SINCE");
  }
  if (request.submap) {
    const Submap* submap = map.Find(*request.submap);
    if (submap == nullptr) return CheckNotRemovedSince(*request.submap, expected, store, map.info().name);
    return CheckNotEdited(*submap, expected);
  }
  // Removed objects, names and regions are only in the log; merges by mapping are only in their objects.
  DHPMAP_ASSIGN_OR_RETURN(const auto last, store.ListEdits(map.info().name, {.max_edits = 1}));
  if (!last.empty() && last.front().entry.revision > expected) {
    return EditedAfter("the map", last.front().entry.revision, expected);
  }
  for (const auto& submap : map.submaps()) DHPMAP_RETURN_IF_ERROR(CheckNotEdited(*submap, expected));
  return Status::Ok();
}

/// The current object, null if it was removed; or the reason why it cannot be restored.
Result<const Submap*> Restorable(const RestoreRequest& request, const MapSnapshot& past, const Map& map) {
  const SubmapId id = *request.submap;
  const Submap* now = map.Find(id);
  if (now != nullptr || !request.etag.empty() || map.info().merged.Into(id)) {
    DHPMAP_ASSIGN_OR_RETURN(now, FindEditable(map, id, request.etag, request.lost));
  }
  if (past.Find(id) != nullptr) return now;
  return NotFound("there was no submap " + std::to_string(id.value) + " at revision " + std::to_string(past.revision()))
      .WithReason("SUBMAP_NOT_FOUND");
}

/// There is one background of each class, apart from those placed by an edit.
Status CheckClassIsFree(const SubmapInfo& past, const Map& map) {
  if (past.panoptic != Panoptic::kStuff || past.is_placed) return Status::Ok();
  for (const auto& other : map.submaps()) {
    const SubmapInfo& info = other->info();
    const bool is_one = info.IsSeenAs(past.class_id) || past.IsSeenAs(info.class_id);
    if (info.id == past.id || info.panoptic != Panoptic::kStuff || info.is_placed || !is_one) continue;
    return Aborted("submap " + std::to_string(past.id.value) + ": its class is that of submap " +
                   std::to_string(info.id.value) + " now")
        .WithReason("UNDO_CONFLICT")
        .WithMetadata("instance_id", std::to_string(past.id.value))
        .WithMetadata("field", "class");
  }
  return Status::Ok();
}

/// Restores the row and the voxels.
void PutAsItWas(const SubmapDelta& delta, Map& map) {
  Submap& submap = map.Find(delta.id) != nullptr ? *map.FindMutable(delta.id) : map.PutBack(delta.after->info);
  submap.mutable_info() = delta.after->info;
  submap.mutable_info().edited_revision = map.info().revision + 1;
  for (const TileDelta& tile : delta.tiles) submap.PutLayers(tile.index, tile.after.get(), tile.differs);
  submap.set_bounding_sphere(delta.after->sphere);
}

/// `past_pairs`: verdicts on it and others, which are not kept for a removed object.
Status RestoreObject(SubmapDelta delta, std::span<const ObjectPair> past_pairs, Map& map) {
  SubmapInfo& past = delta.after->info;
  const Submap* now = map.Find(delta.id);
  // Sessions may have assigned its track ids to others since.
  past.track_id = now != nullptr ? now->info().track_id : 0;
  past.sightings = now != nullptr ? now->info().sightings : Sightings();
  const bool is_moved = now != nullptr && now->info().T_map_submap.matrix() != past.T_map_submap.matrix();
  const bool was_gone = now == nullptr;
  if (is_moved) NoteVacated(*now, map);
  PutAsItWas(delta, map);
  if (is_moved || was_gone) TakeVacatedBack(*map.Find(delta.id), map);
  if (!was_gone) return Status::Ok();
  StateDelta known;
  known.pairs = PairsThatComeBack(delta.id, past_pairs, map);
  return ApplyDelta(known, DeltaSide::kBefore, map);
}

void RestoreAll(const StateDelta& delta, const MapSnapshot& past, Map& map) {
  for (const SubmapDelta& submap : delta.submaps) {
    if (!submap.after) map.Remove(submap.id);
  }
  for (const SubmapDelta& submap : delta.submaps) {
    if (submap.after) PutAsItWas(submap, map);
  }
  for (const VacatedDelta& tile : delta.vacated) {
    map.mutable_vacated().Erase(tile.index);
    if (tile.after != nullptr) map.mutable_vacated().Put(tile.index, tile.after);
  }
  const bool is_same = delta.submaps.empty() && delta.pairs.empty() && delta.merged.empty() &&
                       delta.kept_clear.empty() && delta.display_name.empty();
  if (is_same) return;
  MapInfo& info = map.mutable_info();
  info.merged = past.info().merged;
  info.pairs = past.info().pairs;  // after the removals, which drop the pairs of removed objects
  info.kept_clear = past.info().kept_clear;
  info.display_name = past.info().display_name;
}

EditSummary SummaryOfRestore(const RestoreRequest& request, const StateDelta& delta) {
  EditSummary summary;
  summary.steps = {{EditAction::kRestore, request.submap.value_or(kUnknownSubmap)}};
  summary.restored_revision = request.revision;
  for (const SubmapDelta& submap : delta.submaps) {
    if (submap.before && submap.after) summary.changed.push_back(submap.id);
    if (!submap.before) summary.created.push_back(submap.id);
    if (!submap.after) summary.removed.push_back(submap.id);
  }
  return summary;
}

}  // namespace

Result<EditSummary> RestoreRevision(const RestoreRequest& request, const SnapshotHistory& kept, MapStore& store,
                                    Map& map) {
  const std::shared_ptr<const MapSnapshot> now = map.published();
  const auto present = std::make_shared<const MapView>(now);
  DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewAt(request.revision, present, kept, request.lost, "revision"));
  const MapSnapshot& past = view->snapshot();
  DHPMAP_RETURN_IF_ERROR(CheckExpected(request, store, map));
  StateDelta delta = DiffRows(*now, past);
  if (request.submap) {
    DHPMAP_RETURN_IF_ERROR(Restorable(request, past, map).status());
    DHPMAP_RETURN_IF_ERROR(CheckClassIsFree(past.Find(*request.submap)->info(), map));
    std::erase_if(delta.submaps, [&](const SubmapDelta& submap) { return submap.id != *request.submap; });
  } else {
    DHPMAP_RETURN_IF_ERROR(CheckEtag(request.etag, EtagOf(map.info()), "map '" + map.info().name + "'"));
  }
  AddTiles(*now, past, delta);
  const EditSummary summary = SummaryOfRestore(request, delta);
  if (!request.submap) {
    RestoreAll(delta, past, map);
  } else if (!delta.submaps.empty()) {
    DHPMAP_RETURN_IF_ERROR(RestoreObject(std::move(delta.submaps.front()), past.info().pairs.pairs(), map));
  }
  return summary;
}

}  // namespace dhpmap
