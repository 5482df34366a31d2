// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mapping/base/result.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"
#include "server/app/states/kept_states.h"
#include "storage/store.h"

namespace dhpmap {

/// Back to which revision, and what of the map.
struct RestoreRequest {
  std::int64_t revision = 0;
  std::optional<SubmapId> submap;  ///< alone; nothing: all of the map
  std::string etag;                ///< of the submap, or of the map, as it is now; empty: whatever it is
  /// ABORTED, reason EDITED_SINCE, if an edit or a merge has changed or removed the submap, or anything of the map,
  /// after this revision. 0: whatever was done.
  std::int64_t expected_revision = 0;
  LostRevisions lost = {};  ///< what the map has not in its past
};

/// Takes a map that is as the store has it, or one of its objects, back to what it was at a revision that is kept; with
/// an error it may be half changed. What it did is for the log. Errors of ViewAt, of field "revision".
///   - Of all of a map come back its objects with their voxels, which of them are parts of others, what is known of
///   pairs,
///     regions that are kept clear, what was left as vacated, and its name. Objects that came since go. Ids are not
///     given out again. What sensors have looked through stays known to be free, and frames are counted on.
///   - An object alone comes back, deleted or not, with its pose, class, name, lock and voxels, and one that was gone
///     with what was known of it and others that are there (ObjectPairs); what others have taken of its voxels since
///     they have, too, until refinement has told whose they are. Tracks of front ends stay where they are.
///     NOT_FOUND if it is a part of another now, or was not there then; FAILED_PRECONDITION for the unknown submap;
///     ABORTED, reason UNDO_CONFLICT, for a background whose class another one has by now.
/// Costs what differs between both states.
Result<EditSummary> RestoreRevision(const RestoreRequest& request, const KeptStates& kept, MapStore& store, Map& map);

}  // namespace dhpmap
