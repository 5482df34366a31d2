// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"
#include "mapping/objects/clear_region.h"
#include "server/app/edits/submap_edits.h"
#include "server/app/states/etag.h"

namespace dhpmap {

inline constexpr std::size_t kMaxEdits = 1000;
inline constexpr std::size_t kMaxParts = 64;

/// Of another edit of the list, which comes before: the first object that it made.
struct EarlierResult {
  std::size_t edit = 0;
};
/// An object by its id, or by what made it.
using EditTarget = std::variant<SubmapId, EarlierResult>;

/// Pose, class, name or lock.
struct PatchEdit {
  SubmapPatch patch;
  bool include_supported = false;  ///< with a pose: what stands on it goes along (SupportedBy)
};
/// About the vertical through the middle of its box.
struct TurnEdit {
  double angle_rad = 0;  ///< counterclockwise from above; finite
  bool include_supported = false;
};
struct TranslateEdit {
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< map frame; finite
  bool include_supported = false;
};
/// On another object: see PlacingOf.
struct PlaceEdit {
  EditTarget support;
  std::optional<Eigen::Vector2d> point_m;  ///< map frame; finite
  bool include_supported = false;
};
/// A copy, at the place and with the name given, or those of the original.
struct CloneEdit {
  SubmapPatch patch;
};
struct DeleteEdit {};
/// Of an object that an edit before the list has removed; see UndeleteSubmap.
struct UndeleteEdit {};
/// Makes other things parts of the target, which keeps its id.
struct MergeEdit {
  std::vector<EditTarget> others;
};
/// What lies in the box becomes an object of its own.
struct SplitByBox {
  Eigen::AlignedBox3d box_m;  ///< map frame
};
/// What lies on the side that the normal points to becomes one.
struct SplitByPlane {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< map frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of any length but zero
};
/// Each connected part but the largest becomes one.
struct SplitByParts {
  std::size_t least_voxels = 16;  ///< smaller parts stay
  std::size_t most_parts = kMaxParts;
};
struct SplitEdit {
  std::variant<SplitByBox, SplitByPlane, SplitByParts> by;
  /// Of things, that the parts become, against later votes. A background's parts must have one; a thing's are by
  /// default of the thing's.
  std::optional<ClassId> class_id = {};
};
/// Without a target: of all submaps of these classes, or of all if there are none.
struct ClearEdit {
  Region region;
  std::vector<ClassId> classes;
  std::string keep_clear = {};  ///< not empty: keeps the region clear from then on, under this name
};
/// Of a map, without a target.
struct KeepClearEdit {
  KeptClearRegion region;
};
struct LiftEdit {
  std::string name;
};
struct PresenceEdit {
  Presence presence = Presence::kAbsent;
};

struct Edit {
  std::optional<EditTarget> target;  ///< a ClearEdit may be without; KeepClearEdit and LiftEdit are
  std::string etag;                  ///< of the target before the list (see CheckEtag); empty: whatever it is
  std::variant<PatchEdit, CloneEdit, DeleteEdit, MergeEdit, SplitEdit, ClearEdit, PresenceEdit, KeepClearEdit, LiftEdit,
               UndeleteEdit, TurnEdit, TranslateEdit, PlaceEdit>
      action;
};

struct EditList {
  std::vector<Edit> edits;
  /// ABORTED, reason EDITED_SINCE, if an edit or a merge has changed one of the objects named after this revision;
  /// frames do not count. OUT_OF_RANGE, reason HISTORY_LOST, if it was lost. 0: whatever was done.
  std::int64_t expected_revision = 0;
  /// What the map has not in its past: neither expected_revision nor an etag may be of it.
  LostRevisions lost = {};
  std::string map_etag = {};  ///< of the map itself; empty: whatever it is
  /// UndeleteSubmap of the store that has the map; empty: an UndeleteEdit is INVALID_ARGUMENT.
  std::function<Result<EditSummary>(SubmapId id, const EditConditions& conditions, Map& map)> undelete = {};
};

/// What became of one edit.
struct EditResult {
  std::vector<SubmapId> changed;  ///< objects that are there, in ascending order; none that were so already
  std::vector<SubmapId> created;
  std::vector<SubmapId> removed;
  std::int64_t num_voxels = 0;  ///< that changed hands, or were cleared
};

/// Applies the edits in their order: all of them, or, with an error, none is to be kept (the map may be half changed
/// then). The error names the edit: "edits[2]: ...". NOT_FOUND, FAILED_PRECONDITION and ABORTED as for single edits
/// (submap_edits.h); INVALID_ARGUMENT for an empty list, for more than kMaxEdits, and for what makes no sense;
/// ALREADY_EXISTS, RESOURCE_EXHAUSTED and NOT_FOUND of regions that are kept clear (kept_clear.h;
/// IGNORED_REGION_NOT_FOUND); FAILED_PRECONDITION, by reason: NOT_MERGEABLE (not things, or not on one grid),
/// NOTHING_TO_SPLIT, NOT_A_THING (a background that is to be absent, or to be split into no class of things); without
/// one for what object_motion.h says, and where an object is to be placed on itself or on what goes along. An edit that
/// sets what is so already changes nothing. Moves, clones, names and classes touch rows only (turns, placing and
/// include_supported look at surfaces first), all else the blocks of the objects named.
Result<std::vector<EditResult>> ApplyEdits(const EditList& list, Map& map);

/// A list of one edit that is asked for by itself: the same, but an error names no edit of a list.
Result<EditResult> ApplyOneEdit(const EditList& list_of_one, Map& map);

}  // namespace dhpmap
