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

/// Single numbers of a pose; what is empty stays.
struct PoseChange {
  std::array<std::optional<double>, 3> translation_m;  ///< x, y, z
  std::array<std::optional<double>, 4> rotation_xyzw;  ///< of the quaternion, which need not have a norm of 1
};

/// What to change of a submap; what is empty stays.
struct SubmapPatch {
  std::optional<Transform> T_map_submap;
  std::optional<PoseChange> pose_change;  ///< made to the present pose; only without T_map_submap
  std::optional<ClassId> class_id;        ///< fixes the class against later votes
  std::optional<std::string> display_name;
  std::optional<bool> is_locked;  ///< against mapping and refinement; edits of what is locked are made as ever
};

// Each edit either does all it says or returns an error and has changed nothing: NOT_FOUND for a submap that is not
// there, FAILED_PRECONDITION for the unknown submap, ABORTED for an etag (where not empty) of before another edit or of
// a state that was `lost` (CheckEtag). None touches voxels of an object; what one leaves that is moved or deleted is
// noted in the map (NoteVacated).

/// The submap an edit may work on, under the conditions above.
Result<const Submap*> FindEditable(const Map& map, SubmapId id, const std::string& etag,
                                   const LostRevisions& lost = {});

/// Whether any of it was looked through (Submap::DropGone).
bool HasGone(const Submap& submap);

/// INVALID_ARGUMENT for a class outside the label set or of the other kind, a pose that is not finite or beyond
/// the reach of the grid, or a display name above kMaxDisplayNameBytes. What is so already is no edit; that somebody
/// sets for the first time what the object had by itself is one, as it stays from then on.
Status PatchSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch,
                   const LostRevisions& lost = {});
/// The same without an etag; whether there was anything to change.
Result<bool> PatchSubmap(Map& map, SubmapId id, const SubmapPatch& patch);

/// The id of a copy with a new id, at the place and with the name given, or those of the original.
Result<SubmapId> CloneSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch,
                             const LostRevisions& lost = {});

Status DeleteSubmap(Map& map, SubmapId id, const std::string& etag, const LostRevisions& lost = {});

}  // namespace dhpmap
