// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "mapping/base/result.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/map.h"
#include "storage/store.h"

namespace dhpmap {

inline constexpr std::size_t kMaxUndone = 100;

/// Which edits are to be undone, or done again.
struct UndoRequest {
  EditKind kind = EditKind::kUndo;   ///< or kRedo
  std::optional<std::int64_t> edit;  ///< by its revision, whoever made it; else
  std::size_t count = 1;             ///< the last so many of the author; at most kMaxUndone
  std::string author;                ///< of whose edits
};

/// Undoes edits, or does them again, on a map that is as the store has it: all of them, or, with an error, none is to
/// be kept. What it did is for the log. FAILED_PRECONDITION, by reason: NOTHING_TO_UNDO, NOTHING_TO_REDO,
/// UNDO_NOT_KEPT; NOT_FOUND, reason EDIT_NOT_FOUND; ABORTED, reason UNDO_CONFLICT, the metadata with the `edit` (see
/// ApplyDelta). An author's redo begins with what that author has undone last, and ends at the author's last edit of
/// another kind.
Result<EditSummary> UndoEdits(const UndoRequest& request, MapStore& store, Map& map);

/// Brings back an object that an edit has removed, under its id and as it was, the voxels with it, as long as what
/// undoes that edit is kept. FAILED_PRECONDITION, reason NOTHING_TO_UNDO, if it is there; NOT_FOUND with the reasons of
/// NoSuchSubmap if no such edit is in the log, or it was merged; UNDO_NOT_KEPT.
Result<EditSummary> UndeleteSubmap(SubmapId id, MapStore& store, Map& map);

}  // namespace dhpmap
