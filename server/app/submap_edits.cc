// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/submap_edits.h"

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

Status CheckPatch(const Map& map, const Submap& submap, const SubmapPatch& patch) {
  Status bad = InvalidArgument("the submap cannot be changed like this").WithReason("BAD_EDIT");
  if (patch.T_map_submap && !IsFinite(*patch.T_map_submap)) bad.AddViolation("map_from_submap", "is not finite");
  if (patch.class_id) CheckClass(map, submap, *patch.class_id, bad);
  if (patch.display_name && patch.display_name->size() > kMaxDisplayNameBytes) {
    bad.AddViolation("display_name", "is longer than " + std::to_string(kMaxDisplayNameBytes) + " bytes");
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

void Apply(const SubmapPatch& patch, SubmapInfo& info) {
  if (patch.T_map_submap) info.T_map_submap = *patch.T_map_submap;
  if (patch.display_name) info.display_name = *patch.display_name;
  if (patch.class_id) {
    info.class_id = *patch.class_id;
    info.class_is_fixed = true;
  }
}

}  // namespace

std::string EtagOf(const Submap& submap) { return "r" + std::to_string(submap.info().revision); }

Result<const Submap*> FindEditable(const Map& map, SubmapId id, const std::string& etag) {
  const Submap* submap = map.Find(id);
  const std::string which = "submap " + std::to_string(id.value);
  if (submap == nullptr) return NotFound(which + " does not exist").WithReason("SUBMAP_NOT_FOUND");
  if (id == kUnknownSubmap) {
    return FailedPrecondition("submap 0 holds the geometry of unknown objects and cannot be edited")
        .WithReason("UNKNOWN_SUBMAP");
  }
  if (!etag.empty() && etag != EtagOf(*submap)) {
    return Aborted(which + " has changed: its etag is now " + EtagOf(*submap)).WithReason("ETAG_MISMATCH");
  }
  return submap;
}

Status PatchSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch) {
  DHPMAP_ASSIGN_OR_RETURN(const Submap* submap, FindEditable(map, id, etag));
  DHPMAP_RETURN_IF_ERROR(CheckPatch(map, *submap, patch));
  const bool changes_anything = patch.T_map_submap || patch.class_id || patch.display_name;
  if (changes_anything) Apply(patch, map.FindMutable(id)->mutable_info());
  return Status::Ok();
}

Result<SubmapId> CloneSubmap(Map& map, SubmapId id, const std::string& etag, const SubmapPatch& patch) {
  DHPMAP_ASSIGN_OR_RETURN(const Submap* submap, FindEditable(map, id, etag));
  DHPMAP_RETURN_IF_ERROR(CheckPatch(map, *submap, patch));
  Submap* copy = map.Clone(id);
  Apply(patch, copy->mutable_info());
  return copy->id();
}

Status DeleteSubmap(Map& map, SubmapId id, const std::string& etag) {
  DHPMAP_RETURN_IF_ERROR(FindEditable(map, id, etag).status());
  map.Remove(id);
  return Status::Ok();
}

}  // namespace dhpmap
