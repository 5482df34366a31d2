// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "mapping/base/result.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"
#include "server/app/edits/map_edits.h"
#include "server/app/states/no_such_submap.h"

namespace dhpmap {

/// Components of a pose; empty ones stay.
struct PoseChange {
  std::array<std::optional<double>, 3> translation_m;  ///< x, y, z
  std::array<std::optional<double>, 4> rotation_xyzw;  ///< of the quaternion, of any norm
};

/// Changes of a submap; empty values stay.
struct SubmapPatch {
  std::optional<Transform> T_map_submap;
  std::optional<PoseChange> pose_change;  ///< applied to the present pose; only without T_map_submap
  std::optional<ClassId> class_id;        ///< fixes the class against later votes
  std::optional<std::string> display_name;
  std::optional<bool> is_locked;  ///< read-only for mapping and refinement; edits still apply
};

// Each edit is atomic: on an error nothing has changed. NOT_FOUND for a missing submap, FAILED_PRECONDITION for the
// unknown submap, ABORTED for a non-empty etag from before another edit or of a `lost` state (CheckEtag). None touches
// voxels of an object; the old place of a moved or deleted object becomes vacated space (NoteVacated).

/// The submap to edit, after checking the conditions above.
Result<const Submap*> FindEditable(const Map& map, SubmapId id, const std::string& etag,
                                   const LostRevisions& lost = {});

/// Whether it has gone counts (Submap::DropGone).
bool HasGone(const Submap& submap);

/// INVALID_ARGUMENT for a class outside the label set or of the other kind, a pose that is not finite or beyond the
/// grid, or a display name above kMaxDisplayNameBytes. Setting a present value is no edit, unless the value was not set
/// by an edit before: it is fixed from then on.
Status PatchSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch,
                   const LostRevisions& lost = {});
/// The same without an etag; returns whether anything changed.
Result<bool> PatchSubmap(Map& map, SubmapId id, const SubmapPatch& patch);

/// Returns the id of a copy; pose and name default to those of the original.
Result<SubmapId> CloneSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch,
                             const LostRevisions& lost = {});

Status DeleteSubmap(Map& map, SubmapId id, const std::string& etag, const LostRevisions& lost = {});

}  // namespace dhpmap
