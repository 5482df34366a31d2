// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"
#include "mapping/objects/clear_region.h"
#include "server/app/edits/submap_edits.h"
#include "server/app/states/etag.h"
#include "storage/store.h"

namespace dhpmap {

inline constexpr std::size_t kMaxEdits = 1000;
inline constexpr std::size_t kMaxParts = 64;

/// Refers to an earlier edit of the list: the first object that it created.
struct EarlierResult {
  std::size_t edit = 0;
};
/// An object by its id, or by the edit that creates it.
using EditTarget = std::variant<SubmapId, EarlierResult>;

/// Pose, class, name or lock.
struct PatchEdit {
  SubmapPatch patch;
  bool include_supported = false;  ///< with a pose: moves the things that stand on it, too (SupportedBy)
};
/// Rotation about the vertical through the centre of its box.
struct TurnEdit {
  double angle_rad = 0;  ///< counterclockwise from above; finite
  bool include_supported = false;
};
struct TranslateEdit {
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< map frame; finite
  bool include_supported = false;
};
/// Places it on another object: see PlacingOf.
struct PlaceEdit {
  EditTarget support;
  std::optional<Eigen::Vector2d> point_m;  ///< map frame; finite
  bool include_supported = false;
};
/// A copy; pose and name default to those of the original.
struct CloneEdit {
  SubmapPatch patch;
};
struct DeleteEdit {};
/// Restores an object that an earlier edit has removed; see UndeleteSubmap.
struct UndeleteEdit {};
/// Merges other things into the target, which keeps its id.
struct MergeEdit {
  std::vector<EditTarget> others;
};
/// The part in the box becomes a new object.
struct SplitByBox {
  Eigen::AlignedBox3d box_m;  ///< map frame
};
/// The part on the side of the normal becomes a new object.
struct SplitByPlane {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< map frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of any length but zero
};
/// Each connected part except the largest becomes a new object.
struct SplitByParts {
  std::size_t least_voxels = 16;  ///< smaller parts stay
  std::size_t most_parts = kMaxParts;
};
struct SplitEdit {
  std::variant<SplitByBox, SplitByPlane, SplitByParts> by;
  /// Fixed class of the parts, which become things. Required for a background; for a thing the default is its class.
  std::optional<ClassId> class_id = {};
};
/// Without a target: clears all submaps of these classes, or all if there are none.
struct ClearEdit {
  Region region;
  std::vector<ClassId> classes;
  std::string keep_clear = {};  ///< not empty: also ignores the region from then on, under this name
};
/// Of the map, without a target.
struct KeepClearEdit {
  KeptClearRegion region;
};
struct LiftEdit {
  std::string name;
};
struct PresenceEdit {
  Presence presence = Presence::kAbsent;
};

/// Actions on an existing object, the target.
using ObjectAction = std::variant<PatchEdit, CloneEdit, DeleteEdit, MergeEdit, SplitEdit, PresenceEdit, TurnEdit,
                                  TranslateEdit, PlaceEdit>;
/// Actions without a target, with an optional one, or with a deleted one.
using MapAction = std::variant<ClearEdit, KeepClearEdit, LiftEdit, UndeleteEdit>;

struct Edit {
  std::optional<EditTarget> target;  ///< optional for a ClearEdit; must be empty for KeepClearEdit and LiftEdit
  std::string etag;                  ///< of the target before the list (see CheckEtag); empty: any
  std::variant<ObjectAction, MapAction> action;
};

/// The action of an edit if it is of this type, else null.
template <typename Action>
const Action* ActionIf(const Edit& edit) {
  return std::visit(
      []<typename Kind>(const Kind& kind) -> const Action* {
        if constexpr (std::is_constructible_v<Kind, Action>) return std::get_if<Action>(&kind);
        else return nullptr;
      },
      edit.action);
}

struct EditList {
  std::vector<Edit> edits;
  /// ABORTED, reason EDITED_SINCE, if an edit or a merge has changed one of the named objects after this revision;
  /// frames do not count. OUT_OF_RANGE, reason HISTORY_LOST, for a lost revision. 0: no condition.
  std::int64_t expected_revision = 0;
  /// Lost revisions of the map: expected_revision and etags must not refer to them.
  LostRevisions lost = {};
  std::string map_etag = {};  ///< of the map itself; empty: any
};

/// Effect of one edit.
struct EditResult {
  std::vector<SubmapId> changed;  ///< existing objects that changed, ascending
  std::vector<SubmapId> created;
  std::vector<SubmapId> removed;
  std::int64_t num_voxels = 0;  ///< voxels that moved between objects or were cleared
};

/// Applies the edits in order, all or none; on an error the map may be half changed and must be discarded. The error
/// names the edit: "edits[2]: ...". NOT_FOUND, FAILED_PRECONDITION and ABORTED as for single edits (submap_edits.h);
/// INVALID_ARGUMENT for an empty list, more than kMaxEdits, and meaningless edits; ALREADY_EXISTS, RESOURCE_EXHAUSTED
/// and NOT_FOUND for ignored regions (kept_clear.h; IGNORED_REGION_NOT_FOUND); FAILED_PRECONDITION, by reason:
/// NOT_MERGEABLE (not things, or not on one grid), NOTHING_TO_SPLIT, NOT_A_THING (a background to be made absent, or to
/// be split without a class of things); without a reason as in object_motion.h, and for an object placed on itself or
/// on an object that moves along. Setting an existing value changes nothing. Moves, clones, names and classes touch
/// rows only (turns, placing and include_supported read surfaces first); all other edits touch the blocks of the named
/// objects. `store`: that of the map, for an UndeleteEdit; null: such an edit is INVALID_ARGUMENT.
Result<std::vector<EditResult>> ApplyEdits(const EditList& list, Map& map, MapStore* store = nullptr);

/// Applies a list with a single edit, other than an UndeleteEdit; errors do not name its position.
Result<EditResult> ApplyOneEdit(const EditList& list_of_one, Map& map);

}  // namespace dhpmap
