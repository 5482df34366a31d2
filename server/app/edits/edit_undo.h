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

/// Selects edits to undo or redo.
struct UndoRequest {
  EditKind kind = EditKind::kUndo;   ///< or kRedo
  std::optional<std::int64_t> edit;  ///< one edit, by its revision, of any author; else
  std::size_t count = 1;             ///< the last ones of the author; at most kMaxUndone
  std::string author;                ///< author of these edits
  EditConditions conditions = {};    ///< the etag is the map's
  /// Whether an edit of that author may be named. Empty: any. Else PERMISSION_DENIED, reason NOT_YOUR_NAME.
  std::function<bool(const std::string& author)> is_own = {};
};

/// Undoes or redoes edits on a map in its stored state, all or none; on an error the map must be discarded. Returns the
/// log entry. FAILED_PRECONDITION, by reason: NOTHING_TO_UNDO, NOTHING_TO_REDO, UNDO_NOT_KEPT; NOT_FOUND, reason
/// EDIT_NOT_FOUND; ABORTED, reason UNDO_CONFLICT, with the `edit` in the metadata (see ApplyDelta), ETAG_MISMATCH, and
/// EDITED_SINCE if a selected edit, or the last one of an object that it changed, is later than the expected revision.
/// An author's redo starts with the last undo of that author and ends at the author's last edit of another kind.
Result<EditSummary> UndoEdits(const UndoRequest& request, MapStore& store, Map& map);

/// Restores an object that an edit has removed, under its id, with its voxels and its evidence about pairs
/// (ObjectPairs), as long as the undo data of that edit are kept. FAILED_PRECONDITION, reason NOTHING_TO_UNDO, if it
/// exists; NOT_FOUND with the reasons of NoSuchSubmap if the log has no such edit, or if it was merged; UNDO_NOT_KEPT.
/// ABORTED for an etag that did not match at its deletion; reason EDITED_SINCE if that was after the expected revision.
Result<EditSummary> UndeleteSubmap(SubmapId id, MapStore& store, Map& map, const EditConditions& conditions = {});

/// The pairs among `known` that concern a restored object, as a change to undo. A verdict of two against an object that
/// has been merged since applies to the whole, as it would if the restored object had existed.
ListDelta<ObjectPair> PairsThatComeBack(SubmapId id, std::span<const ObjectPair> known, const Map& map);

}  // namespace dhpmap
