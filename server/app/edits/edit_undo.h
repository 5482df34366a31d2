// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "mapping/base/result.h"
#include "mapping/changes/state_delta.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/map.h"
#include "server/app/states/etag.h"
#include "storage/store.h"

namespace dhpmap {

inline constexpr std::size_t kMaxUndone = 100;

/// Which edits are to be undone, or done again.
struct UndoRequest {
  EditKind kind = EditKind::kUndo;   ///< or kRedo
  std::optional<std::int64_t> edit;  ///< by its revision, whoever made it; else
  std::size_t count = 1;             ///< the last so many of the author; at most kMaxUndone
  std::string author;                ///< of whose edits
  EditConditions conditions = {};    ///< the etag is the map's
  /// Whether an edit of that author may be named. Empty: any. Else PERMISSION_DENIED, reason NOT_YOUR_NAME.
  std::function<bool(const std::string& author)> is_own = {};
};

/// Undoes edits, or does them again, on a map that is as the store has it: all of them, or, with an error, none is to
/// be kept. What it did is for the log. FAILED_PRECONDITION, by reason: NOTHING_TO_UNDO, NOTHING_TO_REDO,
/// UNDO_NOT_KEPT; NOT_FOUND, reason EDIT_NOT_FOUND; ABORTED, reason UNDO_CONFLICT, the metadata with the `edit` (see
/// ApplyDelta), ETAG_MISMATCH, and EDITED_SINCE if an edit that is meant, or the last one of an object that it has
/// changed, is later than the revision expected. An author's redo begins with what that author has undone last, and
/// ends at the author's last edit of another kind.
Result<EditSummary> UndoEdits(const UndoRequest& request, MapStore& store, Map& map);

/// Brings back an object that an edit has removed, under its id and as it was, the voxels with it and what was known of
/// it and others that are there (ObjectPairs), as long as what undoes that edit is kept. FAILED_PRECONDITION, reason
/// NOTHING_TO_UNDO, if it is there; NOT_FOUND with the reasons of NoSuchSubmap if no such edit is in the log, or it was
/// merged; UNDO_NOT_KEPT. ABORTED for an etag that did not hold when it was deleted, reason EDITED_SINCE if that was
/// after the revision expected.
Result<EditSummary> UndeleteSubmap(SubmapId id, MapStore& store, Map& map, const EditConditions& conditions = {});

/// Of the pairs that were `known`, those of an object that comes back: a change to be undone. That it and one that is a
/// part of a third by now must be two holds of the third, as it would if the object had been there.
ListDelta<ObjectPair> PairsThatComeBack(SubmapId id, std::span<const ObjectPair> known, const Map& map);

}  // namespace dhpmap
