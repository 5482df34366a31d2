// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/edit_conversion.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "mapping/labels/class_names.h"
#include "proto/types/label_conversion.h"
#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

/// Reads the edits of one list; records errors with their fields.
class Reader {
 public:
  Reader(const std::string& map, const LabelSet& label_set) : map_(map), label_set_(label_set) {}

  Edit Read(const v1::Edit& proto, std::size_t index) {
    place_ = std::string("edits[").append(std::to_string(index)).append("]");
    Edit edit;
    if (!proto.submap().empty()) edit.target = Target(proto.submap(), "submap");
    else if (!proto.has_clear() && !IsOfMap(proto)) Bad("submap", "is missing");
    if (!proto.submap().empty() && IsOfMap(proto)) Bad("submap", "is not asked for: the edit is one of the map");
    edit.etag = proto.etag();
    switch (proto.edit_case()) {
      case v1::Edit::kMove: edit.action = PatchEdit{Move(proto.move()), proto.move().include_supported()}; break;
      case v1::Edit::kTurn: edit.action = Turn(proto.turn()); break;
      case v1::Edit::kTranslate: edit.action = Translate(proto.translate()); break;
      case v1::Edit::kPlace: edit.action = Place(proto.place()); break;
      case v1::Edit::kClone: edit.action = CloneEdit{Clone(proto.clone())}; break;
      case v1::Edit::kDelete: edit.action = DeleteEdit{}; break;
      case v1::Edit::kRelabel: edit.action = PatchEdit{Relabel(proto.relabel())}; break;
      case v1::Edit::kRename: edit.action = PatchEdit{Rename(proto.rename())}; break;
      case v1::Edit::kMerge: edit.action = Merge(proto.merge()); break;
      case v1::Edit::kSplit: edit.action = Split(proto.split()); break;
      case v1::Edit::kClear: edit.action = Clear(proto.clear()); break;
      case v1::Edit::kPresence: edit.action = SetPresence(proto.presence()); break;
      case v1::Edit::kLock: edit.action = PatchEdit{Lock(true)}; break;
      case v1::Edit::kUnlock: edit.action = PatchEdit{Lock(false)}; break;
      case v1::Edit::kIgnoreRegion:
        edit.action = KeepClearEdit{{proto.ignore_region().name(), RegionOf(proto.ignore_region(), "ignore_region")}};
        break;
      case v1::Edit::kUndelete: edit.action = UndeleteEdit{}; break;
      case v1::Edit::kUnignoreRegion: edit.action = LiftEdit{proto.unignore_region().name()}; break;
      case v1::Edit::EDIT_NOT_SET: Bad("edit", "says nothing to do"); break;
    }
    return edit;
  }

  [[nodiscard]] const Status& bad() const { return bad_; }

 private:
  void Bad(const std::string& field, std::string what) { bad_.AddViolation(place_ + "." + field, std::move(what)); }

  static bool IsOfMap(const v1::Edit& proto) { return proto.has_ignore_region() || proto.has_unignore_region(); }

  EditTarget Target(const std::string& name, const std::string& field) {
    if (name.starts_with('#')) {
      EarlierResult earlier;
      const char* end = name.data() + name.size();
      const auto [stop, error] = std::from_chars(name.data() + 1, end, earlier.edit);
      if (error == std::errc() && stop == end) return earlier;
      Bad(field, "'" + name + "' is no number of an edit");
      return SubmapId();
    }
    const Result<SubmapName> parsed = ParseSubmapName(name, field);
    if (!parsed.ok()) {
      for (const FieldViolation& violation : parsed.status().violations()) Bad(field, violation.description);
      return SubmapId();
    }
    if (parsed->map != map_) Bad(field, "'" + name + "' is of another map");
    return parsed->submap;
  }

  std::optional<Transform> PoseOf(const v1::Pose& proto, const std::string& field) {
    const Result<Transform> T = TransformFromProto(proto, place_ + "." + field);
    if (T.ok()) return *T;
    for (const FieldViolation& violation : T.status().violations()) {
      bad_.AddViolation(violation.field, violation.description);
    }
    return std::nullopt;
  }

  SubmapPatch Move(const v1::MoveEdit& proto) {
    SubmapPatch patch;
    if (proto.has_map_from_submap()) patch.T_map_submap = PoseOf(proto.map_from_submap(), "move.map_from_submap");
    else Bad("move.map_from_submap", "is missing");
    return patch;
  }

  TurnEdit Turn(const v1::TurnEdit& proto) {
    if (!std::isfinite(proto.angle_rad())) Bad("turn.angle_rad", "is not finite");
    return {proto.angle_rad(), proto.include_supported()};
  }

  TranslateEdit Translate(const v1::TranslateEdit& proto) {
    const TranslateEdit translate{VectorFromProto(proto.offset_m()), proto.include_supported()};
    if (!proto.has_offset_m()) Bad("translate.offset_m", "is missing");
    else if (!translate.offset_m.allFinite()) Bad("translate.offset_m", "is not finite");
    return translate;
  }

  PlaceEdit Place(const v1::PlaceEdit& proto) {
    PlaceEdit place{.support = {}, .point_m = std::nullopt, .include_supported = proto.include_supported()};
    if (proto.support().empty()) Bad("place.support", "is missing");
    else place.support = Target(proto.support(), "place.support");
    if (!proto.has_point_m()) return place;
    place.point_m = Eigen::Vector2d(proto.point_m().x(), proto.point_m().y());
    if (!place.point_m->allFinite()) Bad("place.point_m", "is not finite");
    return place;
  }

  SubmapPatch Clone(const v1::CloneEdit& proto) {
    SubmapPatch patch;
    if (proto.has_map_from_submap()) patch.T_map_submap = PoseOf(proto.map_from_submap(), "clone.map_from_submap");
    if (!proto.display_name().empty()) patch.display_name = proto.display_name();
    return patch;
  }

  SubmapPatch Relabel(const v1::RelabelEdit& proto) {
    SubmapPatch patch;
    if (proto.has_class_id() == !proto.class_name().empty()) {
      Bad("relabel", "takes either class_id or class_name");
    } else if (!proto.has_class_id()) {
      patch.class_id = ClassOf(proto.class_name(), "relabel.class_name");
    } else {
      patch.class_id = ClassIdFromProto(proto.class_id());
      if (!patch.class_id) {
        Bad("relabel.class_id", std::to_string(proto.class_id()) + " is not within 0 and 65534");
      }
    }
    return patch;
  }

  static SubmapPatch Rename(const v1::RenameEdit& proto) {
    SubmapPatch patch;
    patch.display_name = proto.display_name();
    return patch;
  }

  static SubmapPatch Lock(bool is_locked) {
    SubmapPatch patch;
    patch.is_locked = is_locked;
    return patch;
  }

  MergeEdit Merge(const v1::MergeEdit& proto) {
    MergeEdit merge;
    if (proto.merged_submaps().empty()) Bad("merge.merged_submaps", "is empty");
    for (const std::string& other : proto.merged_submaps())
      merge.others.push_back(Target(other, "merge.merged_submaps"));
    return merge;
  }

  SplitEdit Split(const v1::SplitEdit& proto) {
    SplitEdit split;
    if (!proto.class_name().empty()) split.class_id = ClassOf(proto.class_name(), "split.class_name");
    switch (proto.by_case()) {
      case v1::SplitEdit::kBox: split.by = SplitByBox{BoxOf(proto.box(), "split.box")}; break;
      case v1::SplitEdit::kPlane: split.by = SplitPlane(proto.plane()); break;
      case v1::SplitEdit::kParts: {
        SplitByParts parts;
        if (proto.parts().min_voxels() < 0) Bad("split.parts.min_voxels", "is negative");
        else if (proto.parts().min_voxels() > 0)
          parts.least_voxels = static_cast<std::size_t>(proto.parts().min_voxels());
        split.by = parts;
        break;
      }
      case v1::SplitEdit::BY_NOT_SET: Bad("split", "says nothing to split by"); break;
    }
    return split;
  }

  SplitByPlane SplitPlane(const v1::Plane& proto) {
    const SplitByPlane plane{VectorFromProto(proto.point_m()), VectorFromProto(proto.normal())};
    if (!plane.point_m.allFinite()) Bad("split.plane.point_m", "is not finite");
    if (!plane.normal.allFinite() || plane.normal.isZero(0)) Bad("split.plane.normal", "must be finite and not zero");
    return plane;
  }

  ClearEdit Clear(const v1::ClearEdit& proto) {
    ClearEdit clear{.region = RegionOf(proto, "clear"), .classes = {}, .keep_clear = proto.ignored_region_name()};
    for (const std::string& name : proto.class_names()) {
      if (const auto id = ClassOf(name, "clear.class_names")) clear.classes.push_back(*id);
    }
    return clear;
  }

  PresenceEdit SetPresence(const v1::PresenceEdit& proto) {
    if (proto.presence() != v1::Submap::PRESENT && proto.presence() != v1::Submap::ABSENT) {
      Bad("presence.presence", "must be PRESENT or ABSENT");
    }
    return {proto.presence() == v1::Submap::ABSENT ? Presence::kAbsent : Presence::kPresent};
  }

  /// Reads the region of a message with a box or a sphere.
  template <typename Message>
  Region RegionOf(const Message& proto, const std::string& field) {
    if (proto.has_box()) return BoxOf(proto.box(), field + ".box");
    if (!proto.has_sphere()) {
      Bad(field, "says no region");
      return {};
    }
    const BoundingSphere sphere{VectorFromProto(proto.sphere().center_m()), proto.sphere().radius_m()};
    if (!sphere.center_m.allFinite() || !std::isfinite(sphere.radius_m) || sphere.radius_m <= 0) {
      Bad(field + ".sphere", "must be finite, with a radius_m above 0");
    }
    return sphere;
  }

  Eigen::AlignedBox3d BoxOf(const v1::AxisAlignedBox& proto, const std::string& field) {
    const Eigen::AlignedBox3d box(VectorFromProto(proto.min_m()), VectorFromProto(proto.max_m()));
    const bool is_finite = box.min().allFinite() && box.max().allFinite();
    if (!is_finite || (box.min().array() > box.max().array()).any()) {
      Bad(field, "must be finite, with min_m below max_m");
    }
    return box;
  }

  std::optional<ClassId> ClassOf(const std::string& name, const std::string& field) {
    if (const LabelClass* found = FindClassByName(label_set_, name)) return found->id;
    Bad(field, NoSuchClassText(label_set_, name, bad_));
    return std::nullopt;
  }

  const std::string& map_;
  const LabelSet& label_set_;
  std::string place_;
  Status bad_ = InvalidArgument("the edits are not usable").WithReason("BAD_EDIT");
};

}  // namespace

Result<EditList> EditListFromProto(const v1::ApplyEditsRequest& request, const std::string& map,
                                   const LabelSet& label_set) {
  EditList list{.edits = {}, .expected_revision = request.expected_revision(), .map_etag = request.etag()};
  Reader reader(map, label_set);
  for (const v1::Edit& edit : request.edits()) {
    if (list.edits.size() > kMaxEdits) break;  // the list will be refused
    list.edits.push_back(reader.Read(edit, list.edits.size()));
  }
  if (!reader.bad().violations().empty()) return reader.bad();
  return list;
}

v1::EditResult ToProto(const EditResult& result, const std::string& map) {
  v1::EditResult proto;
  for (const SubmapId id : result.changed) proto.add_changed_submaps(SubmapResourceName(map, id));
  for (const SubmapId id : result.created) proto.add_created_submaps(SubmapResourceName(map, id));
  for (const SubmapId id : result.removed) proto.add_removed_submaps(SubmapResourceName(map, id));
  proto.set_num_voxels(result.num_voxels);
  return proto;
}

v1::IgnoredRegion ToProto(const KeptClearRegion& region) {
  v1::IgnoredRegion proto;
  proto.set_name(region.name);
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&region.region)) {
    *proto.mutable_box()->mutable_min_m() = ToProto(Eigen::Vector3d(box->min()));
    *proto.mutable_box()->mutable_max_m() = ToProto(Eigen::Vector3d(box->max()));
  } else {
    const auto& sphere = std::get<BoundingSphere>(region.region);
    *proto.mutable_sphere()->mutable_center_m() = ToProto(sphere.center_m);
    proto.mutable_sphere()->set_radius_m(sphere.radius_m);
  }
  return proto;
}

}  // namespace dhpmap
