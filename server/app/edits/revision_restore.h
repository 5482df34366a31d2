// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mapping/base/result.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"
#include "server/app/states/snapshot_history.h"
#include "storage/store.h"

namespace dhpmap {

/// Selects a revision, and the part of the map to restore.
struct RestoreRequest {
  std::int64_t revision = 0;
  std::optional<SubmapId> submap;  ///< only this submap; nothing: the whole map
  std::string etag;                ///< present one of the submap, or of the map; empty: any
  /// ABORTED, reason EDITED_SINCE, if an edit or a merge has changed or removed the submap, or anything of the map,
  /// after this revision. 0: no condition.
  std::int64_t expected_revision = 0;
  LostRevisions lost = {};  ///< lost revisions of the map
};

/// Restores a map in its stored state, or one of its objects, to a kept revision; on an error it may be half changed.
/// Returns the log entry. Errors of ViewAt, for the field "revision".
///   - For the whole map: restores objects with their voxels, merges, evidence of pairs, ignored regions, vacated
///     space, and its name. Objects created since are removed; ids are not reused. Free space stays free, and frame
///     counts continue.
///   - For one object, deleted or not: restores pose, class, name, lock and voxels, and, for a deleted one, its
///     evidence about pairs (ObjectPairs). Voxels that other objects have taken since stay theirs, too, until the next
///     refinement. Tracks of front ends do not change. NOT_FOUND if it was merged since, or did not exist then;
///     FAILED_PRECONDITION for the unknown submap; ABORTED, reason UNDO_CONFLICT, for a background if another submap
///     has its class now.
///
/// Linear in the difference of the two states.
Result<EditSummary> RestoreRevision(const RestoreRequest& request, const SnapshotHistory& kept, MapStore& store,
                                    Map& map);

}  // namespace dhpmap
