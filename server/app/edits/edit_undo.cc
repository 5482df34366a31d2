// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/edit_undo.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "mapping/map/vacated_space.h"
#include "mapping/objects/apply_delta.h"
#include "server/app/edits/submap_edits.h"

namespace dhpmap {
namespace {

Status NothingLeft(const UndoRequest& request, std::size_t num_found) {
  const bool is_undo = request.kind == EditKind::kUndo;
  Status status = FailedPrecondition("'" + request.author + "' has " + std::to_string(num_found) + " edits to " +
                                     (is_undo ? "undo" : "do again") + ", not " + std::to_string(request.count));
  return is_undo ? status.WithReason("NOTHING_TO_UNDO") : status.WithReason("NOTHING_TO_REDO");
}

/// The log of one map.
class Log {
 public:
  Log(MapStore& store, const std::string& map) : store_(store), map_(map) {}

  /// Calls visit(const LoggedEdit&) for edits from the newest on, until it returns false.
  template <typename Visit>
  Status Walk(const std::optional<std::string>& author, Visit&& visit) {
    EditQuery query{.author = author, .max_edits = 200};
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const auto edits, store_.ListEdits(map_, query));
      for (const LoggedEdit& edit : edits) {
        if (!visit(edit)) return Status::Ok();
      }
      if (edits.size() < query.max_edits) return Status::Ok();
      query.before_revision = edits.back().entry.revision;
    }
  }

  /// Nothing if there is no such edit.
  Result<std::optional<LoggedEdit>> Find(std::int64_t revision) {
    if (revision == std::numeric_limits<std::int64_t>::max()) return std::optional<LoggedEdit>();
    DHPMAP_ASSIGN_OR_RETURN(auto edits, store_.ListEdits(map_, {.before_revision = revision + 1, .max_edits = 1}));
    if (edits.empty() || edits[0].entry.revision != revision) return std::optional<LoggedEdit>();
    return std::optional(std::move(edits[0]));
  }

 private:
  MapStore& store_;
  const std::string& map_;
};

Result<std::vector<std::int64_t>> FindNamed(const UndoRequest& request, Log& log) {
  const std::string which = "edit " + std::to_string(*request.edit);
  DHPMAP_ASSIGN_OR_RETURN(const auto edit, log.Find(*request.edit));
  if (!edit) return NotFound("the log of the map has no " + which).WithReason("EDIT_NOT_FOUND");
  if (request.is_own && !request.is_own(edit->entry.source.author)) {
    return Status(StatusCode::kPermissionDenied, which + " is of another author").WithReason("NOT_YOUR_NAME");
  }
  const bool is_undo = request.kind == EditKind::kUndo;
  const bool is_edit = edit->entry.summary.kind == EditKind::kEdit;
  if (is_edit && edit->is_undone != is_undo) return std::vector{*request.edit};
  Status status = FailedPrecondition(which + (!is_edit  ? " is an undo or a redo itself: name the edit that it is of"
                                              : is_undo ? " is undone already"
                                                        : " is not undone"));
  return is_undo ? status.WithReason("NOTHING_TO_UNDO") : status.WithReason("NOTHING_TO_REDO");
}

/// The author's last edits that are not undone, newest first.
Result<std::vector<std::int64_t>> FindUndoable(const UndoRequest& request, Log& log) {
  std::vector<std::int64_t> found;
  DHPMAP_RETURN_IF_ERROR(log.Walk(request.author, [&](const LoggedEdit& edit) {
    if (edit.entry.summary.kind == EditKind::kEdit && !edit.is_undone) found.push_back(edit.entry.revision);
    return found.size() < request.count;
  }));
  if (found.size() < request.count) return NothingLeft(request, found.size());
  return found;
}

/// The author's undone edits since the last edit, the last undone first.
Result<std::vector<std::int64_t>> FindRedoable(const UndoRequest& request, Log& log) {
  std::vector<std::int64_t> undone;
  DHPMAP_RETURN_IF_ERROR(log.Walk(request.author, [&](const LoggedEdit& edit) {
    const EditSummary& summary = edit.entry.summary;
    if (summary.kind == EditKind::kUndo) undone.insert(undone.end(), summary.targets.rbegin(), summary.targets.rend());
    return summary.kind != EditKind::kEdit;
  }));
  std::vector<std::int64_t> found;
  std::set<std::int64_t> seen;
  for (const std::int64_t target : undone) {
    if (found.size() == request.count) break;
    if (!seen.insert(target).second) continue;
    DHPMAP_ASSIGN_OR_RETURN(const auto edit, log.Find(target));
    if (edit && edit->is_undone) found.push_back(target);
  }
  if (found.size() < request.count) return NothingLeft(request, found.size());
  return found;
}

/// The objects that an edit changes, in the form of a summary.
class Touched {
 public:
  void Note(const StateDelta& delta, const Map& map) {
    for (const SubmapDelta& submap : delta.submaps) was_there_.emplace(submap.id, map.Find(submap.id) != nullptr);
  }
  void Tell(const Map& map, EditSummary& summary) const {
    for (const auto& [id, was_there] : was_there_) {
      const bool is_there = map.Find(id) != nullptr;
      if (was_there && is_there) summary.changed.push_back(id);
      if (!was_there && is_there) summary.created.push_back(id);
      if (was_there && !is_there) summary.removed.push_back(id);
    }
  }

 private:
  std::map<SubmapId, bool> was_there_;
};

/// For an object that exists after the edit.
bool HasGivenOrTakenVoxels(const SubmapDelta& submap) {
  const auto writes_surfaces = [](const TileDelta& tile) {
    return tile.differs[static_cast<std::size_t>(BlockLayer::kTsdf)] ||
           tile.differs[static_cast<std::size_t>(BlockLayer::kLabels)];
  };
  return submap.after && std::any_of(submap.tiles.begin(), submap.tiles.end(), writes_surfaces);
}

/// The objects removed by edits after a revision, with the last such edit.
using Removals = std::map<SubmapId, std::int64_t>;
Result<Removals> RemovedSince(std::int64_t revision, Log& log) {
  Removals removals;
  if (revision <= 0) return removals;
  DHPMAP_RETURN_IF_ERROR(log.Walk(std::nullopt, [&](const LoggedEdit& edit) {
    if (edit.entry.revision <= revision) return false;
    for (const SubmapId id : edit.entry.summary.removed) removals.try_emplace(id, edit.entry.revision);
    return true;
  }));
  return removals;
}

/// For an edit to be undone or redone: checks that neither it nor a later edit of the same objects is after `expected`.
Status CheckNoneSince(std::int64_t expected, std::int64_t target, const StateDelta& delta, const Removals& removals,
                      const Map& map) {
  if (expected > 0 && target > expected) {
    return Aborted("edit " + std::to_string(target) + " was made after revision " + std::to_string(expected))
        .WithReason("EDITED_SINCE");
  }
  for (const SubmapDelta& delta_of : delta.submaps) {
    const Submap* submap = map.Find(delta_of.id);
    const auto removal = removals.find(delta_of.id);
    const std::int64_t edited = submap != nullptr           ? submap->info().edited_revision
                                : removal != removals.end() ? removal->second
                                                            : 0;
    if (edited > map.info().revision) continue;  // by this request
    DHPMAP_RETURN_IF_ERROR(CheckNotEditedSince(expected, edited, "submap " + std::to_string(delta_of.id.value)));
  }
  return Status::Ok();
}

Status CheckUndeletion(SubmapId id, std::int64_t removal, const StateDelta& delta, const EditConditions& conditions,
                       const MapInfo& map) {
  const std::string which = "submap " + std::to_string(id.value);
  if (conditions.expected_revision > 0 && removal > conditions.expected_revision) {
    return Aborted(which + " was deleted in revision " + std::to_string(removal) + ", after " +
                   std::to_string(conditions.expected_revision))
        .WithReason("EDITED_SINCE");
  }
  const auto gone = std::find_if(delta.submaps.begin(), delta.submaps.end(),
                                 [id](const SubmapDelta& submap) { return submap.id == id && submap.before; });
  if (gone == delta.submaps.end()) return Status::Ok();
  return CheckEtag(conditions.etag, gone->before->info, map, conditions.lost);
}

}  // namespace

ListDelta<ObjectPair> PairsThatComeBack(SubmapId id, std::span<const ObjectPair> known, const Map& map) {
  std::vector<ObjectPair> pairs;
  for (ObjectPair pair : known) {
    if (pair.first != id && pair.second != id) continue;
    const SubmapId other = pair.first == id ? pair.second : pair.first;
    const std::optional<SubmapId> whole = map.Find(other) == nullptr ? map.info().merged.Into(other) : std::nullopt;
    if (whole && *whole != id && pair.verdict == PairVerdict::kMustBeTwo) {
      pair = {.first = std::min(id, *whole), .second = std::max(id, *whole), .verdict = pair.verdict};
    }
    pairs.push_back(pair);
  }
  // If a pair occurs several times, the first entry counts.
  std::stable_partition(pairs.begin(), pairs.end(),
                        [](const ObjectPair& pair) { return pair.verdict != PairVerdict::kOpen; });
  return {.before = std::move(pairs), .after = {}};
}

Result<EditSummary> UndoEdits(const UndoRequest& request, MapStore& store, Map& map) {
  const std::string name = map.info().name;
  Log log(store, name);
  const bool is_undo = request.kind == EditKind::kUndo;
  DHPMAP_RETURN_IF_ERROR(CheckEtag(request.conditions.etag, EtagOf(map.info()), "map '" + name + "'"));
  DHPMAP_RETURN_IF_ERROR(CheckExpectedRevision(request.conditions, map.info()));
  DHPMAP_ASSIGN_OR_RETURN(const auto targets, request.edit ? FindNamed(request, log)
                                              : is_undo    ? FindUndoable(request, log)
                                                           : FindRedoable(request, log));
  DHPMAP_ASSIGN_OR_RETURN(const Removals removals, RemovedSince(request.conditions.expected_revision, log));
  EditSummary summary{.kind = request.kind, .targets = targets};
  Touched touched;
  for (const std::int64_t target : targets) {
    DHPMAP_ASSIGN_OR_RETURN(const StateDelta delta, store.LoadEdit(name, target));
    DHPMAP_RETURN_IF_ERROR(CheckNoneSince(request.conditions.expected_revision, target, delta, removals, map));
    touched.Note(delta, map);
    const Status applied = ApplyDelta(delta, is_undo ? DeltaSide::kBefore : DeltaSide::kAfter, map);
    if (!applied.ok()) return Status(applied).WithMetadata("edit", std::to_string(target));
  }
  (void)map.mutable_info();  // always makes a revision
  touched.Tell(map, summary);
  return summary;
}

Result<EditSummary> UndeleteSubmap(SubmapId id, MapStore& store, Map& map, const EditConditions& conditions) {
  DHPMAP_RETURN_IF_ERROR(CheckExpectedRevision(conditions, map.info()));
  const std::string which = "submap " + std::to_string(id.value);
  if (map.Find(id) != nullptr) return FailedPrecondition(which + " is there").WithReason("NOTHING_TO_UNDO");
  if (map.info().merged.Into(id) || id >= map.info().next_submap_id) return NoSuchSubmap(map.info(), id);
  const std::string name = map.info().name;
  constexpr int kMostNotKept = 200;
  int num_not_kept = 0;
  std::optional<std::int64_t> removal;
  DHPMAP_RETURN_IF_ERROR(Log(store, name).Walk(std::nullopt, [&](const LoggedEdit& edit) {
    const EditSummary& summary = edit.entry.summary;
    const bool is_it = summary.kind == EditKind::kEdit && !edit.is_undone &&
                       std::binary_search(summary.removed.begin(), summary.removed.end(), id);
    if (is_it) removal = edit.entry.revision;
    // Edits without undo data cannot be undone, nor older ones, except if that edit was only too large.
    num_not_kept = edit.is_kept || summary.kind != EditKind::kEdit ? 0 : num_not_kept + 1;
    return !is_it && num_not_kept < kMostNotKept;
  }));
  if (!removal) return NoSuchSubmap(map.info(), id);
  DHPMAP_ASSIGN_OR_RETURN(StateDelta delta, store.LoadEdit(name, *removal));
  DHPMAP_RETURN_IF_ERROR(CheckUndeletion(id, *removal, delta, conditions, map.info()));
  const bool is_alone = delta.submaps.size() == 1;
  if (std::any_of(delta.submaps.begin(), delta.submaps.end(), HasGivenOrTakenVoxels)) {
    return Aborted(which + " was deleted by an edit that changed the voxels of other objects, too: undo edit " +
                   std::to_string(*removal))
        .WithReason("UNDO_CONFLICT")
        .WithMetadata("instance_id", std::to_string(id.value))
        .WithMetadata("field", "voxels")
        .WithMetadata("edit", std::to_string(*removal));
  }
  std::erase_if(delta.submaps, [id](const SubmapDelta& submap) { return submap.id != id; });
  delta.pairs = PairsThatComeBack(id, delta.pairs.before, map);
  delta.merged = {};
  delta.kept_clear = {};
  delta.display_name = {};
  if (!is_alone) delta.vacated = {};  // others have left parts of it
  DHPMAP_RETURN_IF_ERROR(ApplyDelta(delta, DeltaSide::kBefore, map));
  if (!is_alone) TakeVacatedBack(*map.Find(id), map);
  return EditSummary{.steps = {{EditAction::kUndelete, id}}, .created = {id}};
}

}  // namespace dhpmap
