// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/changes/state_delta.h"
#include "mapping/map/map.h"

namespace dhpmap {

enum class DeltaSide { kBefore, kAfter };

/// Takes what an edit changed to how it was on one side of the edit: undoes it, or does it again. What others have
/// changed meanwhile stays. ABORTED, reason UNDO_CONFLICT, with `instance_id` and `field` in the metadata, if something
/// stands in the way; then the map is half changed, and to be gone back from.
///   - A row's pose, name, lock and class are set if they are as the other side has them; if not, another edit has set
///   them
///     since, which is a conflict. What frames change of a row (presence, activity, times) is set if it is as it was.
///     Counts are changed by what the edit changed.
///   - Layers of tiles of an edit that wrote surfaces or labels must be, as far as a store knows (StoredKey), those of
///     the other side. Of an edit of rows, what was looked through comes back where nothing was since.
///   - An object that the edit made goes only if nothing was added to it; one that it removed comes back under its id,
///     unless it is a part of another by now (MapInfo::merged), which is a conflict. Its track ids come back with it,
///     also from what it was merged into, but for those that its front ends have given to others since.
///   - A region is kept clear again, or no longer, if it is as the other side has it.
///   - What was noted as vacated, merged, or known of pairs goes with it, as far as it is as it was.
/// Every object that is touched counts as edited. Costs what the edit touched.
Status ApplyDelta(const StateDelta& delta, DeltaSide to, Map& map);

}  // namespace dhpmap
