// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/submap_edits.h"

#include <algorithm>
#include <utility>

#include "mapping/base/grid_reach.h"
#include "mapping/map/map_grid.h"
#include "mapping/map/vacated_space.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

void CheckClass(const Map& map, const Submap& submap, ClassId class_id, Status& bad) {
  const LabelClass* wanted = map.info().label_set->Find(class_id);
  if (wanted == nullptr) {
    bad.AddViolation("class_id", std::to_string(class_id.value) + " is not in the map's label set");
  } else if (wanted->panoptic != submap.info().panoptic) {
    bad.AddViolation("class_id", std::to_string(class_id.value) + " (" + wanted->name +
                                     ") is of the other kind: a thing stays a thing, stuff stays stuff");
  }
}

void CheckPose(const Transform& T_map_submap, double voxel_size_m, Status& bad) {
  if (!IsFinite(T_map_submap)) {
    bad.AddViolation("map_from_submap", "is not finite");
  } else if (const std::string problem = WhyBeyondGrid(T_map_submap.translation(), voxel_size_m); !problem.empty()) {
    bad.AddViolation("map_from_submap", problem);
  }
}

Result<Transform> Changed(const Transform& T, const PoseChange& change) {
  Eigen::Vector3d translation_m = T.translation();
  Eigen::Vector4d xyzw = Eigen::Quaterniond(T.linear()).coeffs();
  for (int i = 0; i < 3; ++i) translation_m[i] = change.translation_m[i].value_or(translation_m[i]);
  for (int i = 0; i < 4; ++i) xyzw[i] = change.rotation_xyzw[i].value_or(xyzw[i]);
  return TransformFromQuaternion(translation_m, xyzw, "map_from_submap");
}

/// The pose in the patch, if there is one.
std::optional<Transform> PoseOf(const SubmapPatch& patch, const Submap& submap, Status& bad) {
  if (patch.T_map_submap || !patch.pose_change) return patch.T_map_submap;
  const auto T = Changed(submap.info().T_map_submap, *patch.pose_change);
  for (const FieldViolation& violation : T.status().violations()) {
    bad.AddViolation(violation.field, violation.description);
  }
  return T.ok() ? std::optional(*T) : std::nullopt;
}

/// Places the submap by an edit: earlier evidence of its absence no longer counts.
void Place(Submap& submap) {
  submap.DropGone();
  submap.mutable_info().presence = Presence::kPresent;
  submap.mutable_info().is_placed = true;
}

/// The patch with its final pose, if the map permits it.
Result<SubmapPatch> Checked(const Map& map, const Submap& submap, SubmapPatch patch) {
  Status bad = InvalidArgument("the submap cannot be changed like this").WithReason("BAD_EDIT");
  patch.T_map_submap = PoseOf(patch, submap, bad);
  if (patch.T_map_submap) CheckPose(*patch.T_map_submap, submap.info().voxel_size_m, bad);
  if (patch.class_id) CheckClass(map, submap, *patch.class_id, bad);
  if (patch.display_name && patch.display_name->size() > kMaxDisplayNameBytes) {
    bad.AddViolation("display_name", "is longer than " + std::to_string(kMaxDisplayNameBytes) + " bytes");
  }
  if (!bad.violations().empty()) return bad;
  return patch;
}

/// Whether the submap was placed there by an edit. Answers contain poses as quaternions, which differ from the matrix
/// by rounding: a client that sends one back changes nothing.
bool IsPlacedAt(const Transform& T_map_submap, const Submap& submap) {
  const SubmapInfo& info = submap.info();
  if (!info.is_placed || submap.IsAbsent() || HasGone(submap)) return false;
  if (T_map_submap.matrix() == info.T_map_submap.matrix()) return true;
  const auto answered = Changed(info.T_map_submap, {});
  return answered.ok() && T_map_submap.matrix() == answered->matrix();
}

/// The part of the patch that differs from the submap.
SubmapPatch Differing(SubmapPatch patch, const Submap& submap) {
  const SubmapInfo& info = submap.info();
  if (patch.T_map_submap && IsPlacedAt(*patch.T_map_submap, submap)) patch.T_map_submap.reset();
  if (info.class_is_fixed && patch.class_id == info.class_id) patch.class_id.reset();
  if (patch.display_name == info.display_name) patch.display_name.reset();
  if (patch.is_locked == info.is_locked) patch.is_locked.reset();
  return patch;
}

void Apply(const SubmapPatch& patch, const MapInfo& map, Submap& submap) {
  SubmapInfo& info = submap.mutable_info();
  info.edited_revision = map.revision + 1;
  if (patch.T_map_submap) {
    info.T_map_submap = *patch.T_map_submap;
    Place(submap);
  }
  if (patch.display_name) info.display_name = *patch.display_name;
  if (patch.is_locked) info.is_locked = *patch.is_locked;
  if (patch.class_id) {
    info.class_id = *patch.class_id;
    info.class_is_fixed = true;
  }
}

}  // namespace

Result<const Submap*> FindEditable(const Map& map, SubmapId id, const std::string& etag, const LostRevisions& lost) {
  const Submap* submap = map.Find(id);
  if (submap == nullptr) return NoSuchSubmap(map.info(), id);
  if (id == kUnknownSubmap) {
    return FailedPrecondition("submap 0 holds the geometry of unknown objects and cannot be edited")
        .WithReason("UNKNOWN_SUBMAP");
  }
  DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, submap->info(), map.info(), lost));
  return submap;
}

bool HasGone(const Submap& submap) {
  const auto tiles = submap.blocks().tiles();
  return std::any_of(tiles.begin(), tiles.end(),
                     [](const TileEntry& tile) { return tile.tile->CellsWith(BlockLayer::kGone) != 0; });
}

Result<bool> PatchSubmap(Map& map, SubmapId id, const SubmapPatch& patch) {
  DHPMAP_ASSIGN_OR_RETURN(const Submap* submap, FindEditable(map, id, {}));
  DHPMAP_ASSIGN_OR_RETURN(SubmapPatch checked, Checked(map, *submap, patch));
  const SubmapPatch differing = Differing(std::move(checked), *submap);
  const bool changes_anything =
      differing.T_map_submap || differing.class_id || differing.display_name || differing.is_locked;
  if (!changes_anything) return false;
  const bool leaves = differing.T_map_submap && IsExclusive(submap->info(), map.info().config);
  // The move drops parts of it that are gone; these are not vacated by the move.
  const bool is_noted_later = leaves && !HasGone(*submap);
  if (leaves && !is_noted_later) NoteVacated(*submap, map);
  Apply(differing, map.info(), *map.FindMutable(id));
  if (is_noted_later) map.NoteLeaving(id);
  return true;
}

Status PatchSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch,
                   const LostRevisions& lost) {
  DHPMAP_RETURN_IF_ERROR(FindEditable(map, id, etag, lost).status());
  return PatchSubmap(map, id, patch).status();
}

Result<SubmapId> CloneSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch,
                             const LostRevisions& lost) {
  DHPMAP_ASSIGN_OR_RETURN(const Submap* submap, FindEditable(map, id, etag, lost));
  DHPMAP_ASSIGN_OR_RETURN(const SubmapPatch checked, Checked(map, *submap, patch));
  Submap* copy = map.Clone(id);
  Apply(checked, map.info(), *copy);
  Place(*copy);
  copy->mutable_info().is_confirmed = true;  // by request of a user: must not be dissolved as a false detection
  return copy->id();
}

Status DeleteSubmap(Map& map, SubmapId id, const std::string& etag, const LostRevisions& lost) {
  DHPMAP_ASSIGN_OR_RETURN(const Submap* submap, FindEditable(map, id, etag, lost));
  NoteVacated(*submap, map);
  map.Remove(id);
  return Status::Ok();
}

}  // namespace dhpmap
