// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/submap_conversion.h"

#include <google/protobuf/util/field_mask_util.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "mapping/labels/class_names.h"
#include "mapping/submap/display_name.h"
#include "proto/types/label_conversion.h"
#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

using google::protobuf::FieldMask;
using google::protobuf::util::FieldMaskUtil;

/// Classes given by id and by name; nothing if neither list is given: then all pass.
std::optional<std::vector<ClassId>> ClassesFromProto(const v1::ListSubmapsRequest& request, const LabelSet& label_set,
                                                     Status& bad) {
  if (request.class_ids().empty() && request.class_names().empty()) return std::nullopt;
  std::set<ClassId> by_id, by_name;
  for (const int id : request.class_ids()) {
    if (const auto class_id = ClassIdFromProto(id)) by_id.insert(*class_id);
    else bad.AddViolation("class_ids", std::to_string(id) + " is not within 0 and 65534");
  }
  for (const std::string& name : request.class_names()) {
    if (const LabelClass* found = FindClassByName(label_set, name)) by_name.insert(found->id);
    else bad.AddViolation("class_names", NoSuchClassText(label_set, name, bad));
  }
  if (request.class_names().empty()) return std::vector<ClassId>(by_id.begin(), by_id.end());
  if (request.class_ids().empty()) return std::vector<ClassId>(by_name.begin(), by_name.end());
  std::vector<ClassId> both;
  std::set_intersection(by_id.begin(), by_id.end(), by_name.begin(), by_name.end(), std::back_inserter(both));
  return both;
}

constexpr const char* kChangeable[] = {"map_from_submap", "class_id", "display_name", "locked"};

FieldMask MaskOf(const v1::UpdateSubmapRequest& request) {
  const auto& paths = request.update_mask().paths();
  FieldMask mask;
  if (std::find(paths.begin(), paths.end(), "*") != paths.end()) {
    for (const char* field : kChangeable) mask.add_paths(field);
    return mask;
  }
  if (!paths.empty()) return request.update_mask();
  if (request.submap().has_map_from_submap()) mask.add_paths("map_from_submap");
  if (request.submap().has_class_id()) mask.add_paths("class_id");
  if (!request.submap().display_name().empty()) mask.add_paths("display_name");
  if (request.submap().locked()) mask.add_paths("locked");
  return mask;
}

/// Whether the mask names exactly this field.
bool Names(const FieldMask& mask, std::string_view field) {
  return std::find(mask.paths().begin(), mask.paths().end(), field) != mask.paths().end();
}

/// Whether the mask names the field or a message that contains it.
bool Covers(const FieldMask& mask, std::string_view field) {
  return std::any_of(mask.paths().begin(), mask.paths().end(), [field](const std::string& path) {
    return field == path || (field.size() > path.size() && field.starts_with(path) && field[path.size()] == '.');
  });
}

bool TouchesPose(const FieldMask& mask) {
  return std::any_of(mask.paths().begin(), mask.paths().end(), [](const std::string& path) {
    return path == "map_from_submap" || path.starts_with("map_from_submap.");
  });
}

void SetOutline(const SubmapOutline& outline, v1::Submap& proto) {
  const UprightBox& box = outline.box;
  Transform T_map_box(Eigen::AngleAxisd(box.yaw_rad, Eigen::Vector3d::UnitZ()));
  T_map_box.translation() = box.center_m;
  *proto.mutable_oriented_box()->mutable_pose() = ToProto(T_map_box);
  *proto.mutable_oriented_box()->mutable_size_m() = ToProto(box.size_m);
  for (const Eigen::Vector2d& corner : outline.footprint_m) {
    proto.mutable_footprint()->add_xy_m(corner.x());
    proto.mutable_footprint()->add_xy_m(corner.y());
  }
  if (outline.support_height_m) proto.set_support_height_m(*outline.support_height_m);
}

}  // namespace

v1::Submap ToProto(const Submap& submap, const MapView& view, OutlineCache::Reading reading) {
  v1::Submap proto = ToProto(submap.info(), view.ObservedSphereInMap(submap),
                             static_cast<std::int64_t>(submap.blocks().size()), view.snapshot().info());
  if (const auto outline = view.OutlineInMap(submap, reading)) SetOutline(*outline, proto);
  return proto;
}

v1::Submap ToProto(const SubmapInfo& info, const BoundingSphere& observed, std::int64_t num_blocks,
                   const MapInfo& map) {
  v1::Submap proto;
  proto.set_name(SubmapResourceName(map.name, info.id));
  proto.set_instance_id(info.id.value);
  proto.set_kind(ToProto(info.panoptic));
  if (info.panoptic != Panoptic::kUnknown) {
    proto.set_class_id(info.class_id.value);
    if (const LabelClass* c = map.label_set->Find(info.class_id)) proto.set_class_name(c->name);
    proto.set_class_confidence(info.ClassConfidence());
    proto.set_instance_confidence(info.instance_confidence);
  }
  proto.set_display_name(DisplayNameOf(info, *map.label_set));
  *proto.mutable_map_from_submap() = ToProto(info.T_map_submap);
  if (!observed.IsEmpty()) {
    *proto.mutable_bounding_sphere()->mutable_center_m() = ToProto(observed.center_m);
    proto.mutable_bounding_sphere()->set_radius_m(observed.radius_m);
  }
  proto.set_voxel_size_m(info.voxel_size_m);
  proto.set_truncation_m(info.truncation_m);
  proto.set_num_blocks(num_blocks);
  proto.set_presence(info.presence == Presence::kAbsent ? v1::Submap::ABSENT : v1::Submap::PRESENT);
  if (info.last_contradicted_ns != 0) proto.set_last_contradicted_stamp_ns(info.last_contradicted_ns);
  proto.set_activity(info.activity == Activity::kActive ? v1::Submap::ACTIVE : v1::Submap::INACTIVE);
  proto.set_confirmed(info.is_confirmed);
  proto.set_num_frames_observed(info.num_frames_observed);
  if (info.num_frames_observed > 0) {
    proto.set_first_observed_stamp_ns(info.first_observed_ns);
    proto.set_last_observed_stamp_ns(info.last_observed_ns);
  }
  proto.set_locked(info.is_locked);
  proto.set_revision(info.revision);
  proto.set_etag(EtagOf(info, map));
  return proto;
}

Result<SubmapFilter> FilterFromProto(const v1::ListSubmapsRequest& request, const LabelSet& label_set) {
  Status bad = InvalidArgument("the filter is not usable").WithReason("BAD_FILTER");
  SubmapFilter filter;
  filter.classes = ClassesFromProto(request, label_set, bad);
  if (request.kind() == v1::LabelClass::THING) filter.panoptic = Panoptic::kThing;
  else if (request.kind() == v1::LabelClass::STUFF) filter.panoptic = Panoptic::kStuff;
  else if (request.kind() != v1::LabelClass::PANOPTIC_KIND_UNSPECIFIED)
    bad.AddViolation("kind", "is not a known value");
  if (request.has_region()) {
    filter.region = {.min_m = VectorFromProto(request.region().min_m()),
                     .max_m = VectorFromProto(request.region().max_m())};
    const bool is_finite = filter.region->min_m.allFinite() && filter.region->max_m.allFinite();
    if (!is_finite || (filter.region->min_m.array() > filter.region->max_m.array()).any()) {
      bad.AddViolation("region", "must be finite, with min_m below max_m");
    }
  }
  if (request.has_sphere()) {
    filter.near = {.center_m = VectorFromProto(request.sphere().center_m()), .radius_m = request.sphere().radius_m()};
    if (!filter.near->center_m.allFinite() || !std::isfinite(filter.near->radius_m) || filter.near->radius_m < 0) {
      bad.AddViolation("sphere", "must be finite, with a radius_m of 0 or more");
    }
  }
  if (!bad.violations().empty()) return bad;
  return filter;
}

namespace {

Status CheckUpdateMask(const v1::UpdateSubmapRequest& request) {
  Status bad = InvalidArgument("the update mask is not usable").WithReason("BAD_UPDATE_MASK");
  for (const std::string& path : request.update_mask().paths()) {
    const std::string field = path.substr(0, path.find('.'));
    if (path == "*") continue;
    if (!FieldMaskUtil::IsValidPath<v1::Submap>(path)) {
      bad.AddViolation("update_mask", "a submap has no field '" + path + "'");
    } else if (field != "name" && field != "etag" &&
               std::find(std::begin(kChangeable), std::end(kChangeable), field) == std::end(kChangeable)) {
      bad.AddViolation("update_mask", "'" + path + "' cannot be changed");
    }
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

/// The numbers of the pose that a mask names.
PoseChange PoseChangeFromProto(const v1::Pose& pose, const FieldMask& mask) {
  const auto given = [&mask](const char* field, double value) {
    return Covers(mask, field) ? std::optional(value) : std::nullopt;
  };
  v1::Quaternion rotation = pose.rotation();
  if (!pose.has_rotation() && Names(mask, "map_from_submap.rotation")) rotation.set_w(1);  // missing: the identity
  const v1::Vector3& t = pose.translation_m();
  return {.translation_m = {given("map_from_submap.translation_m.x", t.x()),
                            given("map_from_submap.translation_m.y", t.y()),
                            given("map_from_submap.translation_m.z", t.z())},
          .rotation_xyzw = {
              given("map_from_submap.rotation.x", rotation.x()), given("map_from_submap.rotation.y", rotation.y()),
              given("map_from_submap.rotation.z", rotation.z()), given("map_from_submap.rotation.w", rotation.w())}};
}

void AddPose(const v1::Pose& pose, const FieldMask& mask, SubmapPatch& patch, Status& bad) {
  if (!Names(mask, "map_from_submap")) {
    patch.pose_change = PoseChangeFromProto(pose, mask);
    return;
  }
  const auto T = TransformFromProto(pose, "map_from_submap");
  if (T.ok()) patch.T_map_submap = *T;
  for (const FieldViolation& violation : T.status().violations()) {
    bad.AddViolation(violation.field, violation.description);
  }
}

}  // namespace

Result<SubmapPatch> PatchFromProto(const v1::UpdateSubmapRequest& request) {
  DHPMAP_RETURN_IF_ERROR(CheckUpdateMask(request));
  const FieldMask mask = MaskOf(request);
  const v1::Submap& submap = request.submap();
  Status bad = InvalidArgument("the submap cannot be changed like this").WithReason("BAD_EDIT");
  SubmapPatch patch;
  if (Covers(mask, "display_name")) patch.display_name = submap.display_name();
  if (Covers(mask, "locked")) patch.is_locked = submap.locked();
  if (Covers(mask, "class_id")) {
    patch.class_id = ClassIdFromProto(submap.class_id());
    if (!patch.class_id) {
      bad.AddViolation("class_id", std::to_string(submap.class_id()) + " is not within 0 and 65534");
    }
  }
  if (TouchesPose(mask)) AddPose(submap.map_from_submap(), mask, patch, bad);
  if (!bad.violations().empty()) return bad;
  return patch;
}

Result<SubmapPatch> PatchFromProto(const v1::CloneSubmapRequest& request) {
  SubmapPatch patch;
  if (!request.display_name().empty()) patch.display_name = request.display_name();
  if (request.has_map_from_submap()) {
    DHPMAP_ASSIGN_OR_RETURN(patch.T_map_submap, TransformFromProto(request.map_from_submap(), "map_from_submap"));
  }
  return patch;
}

}  // namespace dhpmap
