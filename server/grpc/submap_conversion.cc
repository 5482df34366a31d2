// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/submap_conversion.h"

#include <google/protobuf/util/field_mask_util.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>

#include "server/grpc/map_conversion.h"
#include "server/grpc/resource_names.h"
#include "server/ingest/pose_conversion.h"

namespace dhpmap {
namespace {

using google::protobuf::FieldMask;
using google::protobuf::util::FieldMaskUtil;

constexpr std::uint32_t kMaxClassId = 65534;

Eigen::Vector3d VectorFromProto(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

void SetVector(const Eigen::Vector3d& value, v1::Vector3* proto) {
  proto->set_x(value.x());
  proto->set_y(value.y());
  proto->set_z(value.z());
}

/// Classes named by id and by name; a list that is not given passes all.
std::optional<std::vector<ClassId>> ClassesFromProto(const v1::ListSubmapsRequest& request, const LabelSet& label_set,
                                                     Status& bad) {
  if (request.class_ids().empty() && request.class_names().empty()) return std::nullopt;
  std::set<ClassId> by_id, by_name;
  for (const int id : request.class_ids()) {
    if (id >= 0 && static_cast<std::uint32_t>(id) <= kMaxClassId) by_id.insert(ClassId(static_cast<std::uint16_t>(id)));
    else bad.AddViolation("class_ids", std::to_string(id) + " is not within 0 and 65534");
  }
  for (const std::string& name : request.class_names()) {
    const auto& classes = label_set.classes();
    const auto found = std::find_if(classes.begin(), classes.end(), [&](const auto& c) { return c.name == name; });
    if (found != classes.end()) by_name.insert(found->id);
    else bad.AddViolation("class_names", "the label set has no class '" + name + "'");
  }
  if (request.class_names().empty()) return std::vector<ClassId>(by_id.begin(), by_id.end());
  if (request.class_ids().empty()) return std::vector<ClassId>(by_name.begin(), by_name.end());
  std::vector<ClassId> both;
  std::set_intersection(by_id.begin(), by_id.end(), by_name.begin(), by_name.end(), std::back_inserter(both));
  return both;
}

FieldMask MaskOf(const v1::UpdateSubmapRequest& request) {
  if (request.update_mask().paths_size() > 0) return request.update_mask();
  FieldMask mask;
  if (request.submap().has_map_from_submap()) mask.add_paths("map_from_submap");
  if (request.submap().class_id() != 0) mask.add_paths("class_id");
  if (!request.submap().display_name().empty()) mask.add_paths("display_name");
  return mask;
}

bool Covers(const FieldMask& mask, const std::string& field) {
  return std::any_of(mask.paths().begin(), mask.paths().end(),
                     [&field](const std::string& path) { return path == field || path.starts_with(field + "."); });
}

}  // namespace

v1::Submap ToProto(const Submap& submap, const MapInfo& map) {
  const SubmapInfo& info = submap.info();
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
  proto.set_display_name(info.display_name);
  *proto.mutable_map_from_submap() = ToProto(info.T_map_submap);
  if (const BoundingSphere sphere = submap.BoundingSphereInMap(); !sphere.IsEmpty()) {
    SetVector(sphere.center_m, proto.mutable_bounding_sphere()->mutable_center_m());
    proto.mutable_bounding_sphere()->set_radius_m(sphere.radius_m);
  }
  proto.set_voxel_size_m(info.voxel_size_m);
  proto.set_truncation_m(info.truncation_m);
  proto.set_num_blocks(static_cast<std::int64_t>(submap.blocks().size()));
  proto.set_activity(info.activity == Activity::kActive ? v1::ACTIVE : v1::INACTIVE);
  proto.set_confirmed(info.is_confirmed);
  proto.set_num_frames_observed(info.num_frames_observed);
  proto.set_first_observed_ns(info.first_observed_ns);
  proto.set_last_observed_ns(info.last_observed_ns);
  proto.set_revision(info.revision);
  proto.set_etag(EtagOf(submap));
  return proto;
}

Result<SubmapFilter> FilterFromProto(const v1::ListSubmapsRequest& request, const LabelSet& label_set) {
  Status bad = InvalidArgument("the filter is not usable").WithReason("BAD_FILTER");
  SubmapFilter filter;
  filter.classes = ClassesFromProto(request, label_set, bad);
  if (request.kind() == v1::THING) filter.panoptic = Panoptic::kThing;
  else if (request.kind() == v1::STUFF) filter.panoptic = Panoptic::kStuff;
  else if (request.kind() != v1::PANOPTIC_KIND_UNSPECIFIED) bad.AddViolation("kind", "is not a known value");
  if (request.has_region()) {
    filter.region = {.min_m = VectorFromProto(request.region().min_m()),
                     .max_m = VectorFromProto(request.region().max_m())};
    const bool is_finite = filter.region->min_m.allFinite() && filter.region->max_m.allFinite();
    if (!is_finite || (filter.region->min_m.array() > filter.region->max_m.array()).any()) {
      bad.AddViolation("region", "must be finite, with min_m below max_m");
    }
  }
  if (request.has_near()) {
    filter.near = {.center_m = VectorFromProto(request.near().center_m()), .radius_m = request.near().radius_m()};
    if (!filter.near->center_m.allFinite() || !std::isfinite(filter.near->radius_m) || filter.near->radius_m < 0) {
      bad.AddViolation("near", "must be finite, with a radius_m of 0 or more");
    }
  }
  if (!bad.violations().empty()) return bad;
  return filter;
}

Status CheckUpdateMask(const v1::UpdateSubmapRequest& request) {
  Status bad = InvalidArgument("the update mask is not usable").WithReason("BAD_UPDATE_MASK");
  for (const std::string& path : request.update_mask().paths()) {
    const std::string field = path.substr(0, path.find('.'));
    if (!FieldMaskUtil::IsValidPath<v1::Submap>(path)) {
      bad.AddViolation("update_mask", "a submap has no field '" + path + "'");
    } else if (field != "map_from_submap" && field != "class_id" && field != "display_name" && field != "name" &&
               field != "etag") {
      bad.AddViolation("update_mask", "'" + path + "' cannot be changed");
    }
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

Result<SubmapPatch> PatchFromProto(const v1::UpdateSubmapRequest& request, const Submap& current, const MapInfo& map) {
  const FieldMask mask = MaskOf(request);
  FieldMaskUtil::MergeOptions replace;
  replace.set_replace_message_fields(true);
  replace.set_replace_repeated_fields(true);
  v1::Submap merged = ToProto(current, map);
  FieldMaskUtil::MergeMessageTo(request.submap(), mask, replace, &merged);

  Status bad = InvalidArgument("the submap cannot be changed like this").WithReason("BAD_EDIT");
  SubmapPatch patch;
  if (Covers(mask, "display_name")) patch.display_name = merged.display_name();
  if (Covers(mask, "class_id")) {
    if (merged.class_id() < 0 || static_cast<std::uint32_t>(merged.class_id()) > kMaxClassId) {
      bad.AddViolation("class_id", std::to_string(merged.class_id()) + " is not within 0 and 65534");
    } else {
      patch.class_id = ClassId(static_cast<std::uint16_t>(merged.class_id()));
    }
  }
  if (Covers(mask, "map_from_submap")) {
    const auto T = TransformFromProto(merged.map_from_submap(), "map_from_submap");
    if (T.ok()) patch.T_map_submap = *T;
    for (const FieldViolation& violation : T.status().violations()) {
      bad.AddViolation(violation.field, violation.description);
    }
  }
  if (!bad.violations().empty()) return bad;
  return patch;
}

}  // namespace dhpmap
