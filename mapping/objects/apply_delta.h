// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/changes/state_delta.h"
#include "mapping/map/map.h"

namespace dhpmap {

enum class DeltaSide { kBefore, kAfter };

/// Restores one side of an edit's changes: undo or redo. Later changes by others stay. ABORTED, reason UNDO_CONFLICT,
/// with `instance_id` and `field` in the metadata, on a conflict; the map is then half changed and must be rolled back.
///   - A row's pose, name, lock and class are set if they have the values of the other side. Otherwise, a later edit
///     has set them, which is a conflict. Values that frames change (presence, activity, times) are set if unchanged.
///     Counts change by the difference of the edit.
///   - For an edit that wrote surfaces or labels, its tile layers must be those of the other side, as far as the
///     store's keys tell (StoredKey). For an edit of rows only, the gone layer is restored where nothing was counted
///     since.
///   - An object that the edit created is removed only if nothing was added to it. A removed object returns under its
///     id; a later merge of it (MapInfo::merged) is a conflict. Its track ids return with it, also from the object it
///     was merged into, except those that front ends have reassigned since.
///   - A region is ignored again, or no longer, if it is as on the other side.
///   - Vacated space, merges and pairs are restored as far as they are unchanged.
///
/// Every object that is touched counts as edited. Time is linear in the edit's changes.
Status ApplyDelta(const StateDelta& delta, DeltaSide to, Map& map);

}  // namespace dhpmap
