// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/objects.h"

#include <algorithm>

#include "clients/cpp/src/convert/geometry.h"

namespace dhpmap::client {
namespace {

Kind PanopticKindOf(v1::LabelClass::Kind kind) {
  switch (kind) {
    case v1::LabelClass::THING: return Kind::kThing;
    case v1::LabelClass::STUFF: return Kind::kStuff;
    default: return Kind::kUnknown;
  }
}

Label LabelOf(const v1::LabelClass& its) {
  Label label{its.id(), its.name(), PanopticKindOf(its.kind())};
  if (its.size() == v1::LabelClass::SMALL) label.size = Label::Size::kSmall;
  if (its.size() == v1::LabelClass::LARGE) label.size = Label::Size::kLarge;
  return label;
}

void ReadOutline(const v1::Submap& submap, Object& object) {
  if (submap.has_oriented_box()) {
    object.box = {FromProto(submap.oriented_box().pose()), FromProto(submap.oriented_box().size_m())};
  }
  const auto& xy_m = submap.footprint().xy_m();
  for (int i = 0; i + 1 < xy_m.size(); i += 2) object.footprint_m.push_back({xy_m[i], xy_m[i + 1]});
  if (submap.has_support_height_m()) object.support_height_m = submap.support_height_m();
  if (submap.has_bounding_sphere()) object.bounding_sphere = FromProto(submap.bounding_sphere());
}

}  // namespace

Object FromProto(const v1::Submap& submap) {
  Object object;
  object.id = submap.instance_id();
  object.name = submap.display_name();
  object.kind = PanopticKindOf(submap.kind());
  object.class_name = submap.class_name();
  if (submap.has_class_id()) object.class_id = submap.class_id();
  object.T_map_object = FromProto(submap.map_from_submap());
  ReadOutline(submap, object);
  object.class_confidence = submap.class_confidence();
  object.instance_confidence = submap.instance_confidence();
  object.is_present = submap.presence() != v1::Submap::ABSENT;
  object.is_active = submap.activity() == v1::Submap::ACTIVE;
  object.is_confirmed = submap.confirmed();
  object.is_locked = submap.locked();
  object.num_frames = submap.num_frames_observed();
  if (submap.has_first_observed_stamp_ns()) object.first_seen_ns = submap.first_observed_stamp_ns();
  if (submap.has_last_observed_stamp_ns()) object.last_seen_ns = submap.last_observed_stamp_ns();
  object.revision = submap.revision();
  object.etag = submap.etag();
  return object;
}

Object FromProto(const v1::SubmapMatch& match) {
  Object object = FromProto(match.submap());
  if (match.has_nearest_point_m()) {
    object.distance_m = match.distance_m();
    object.nearest_point_m = FromProto(match.nearest_point_m());
  }
  if (match.has_box()) object.bounds = FromProto(match.box());
  return object;
}

MapInfo FromProto(const v1::Map& map) {
  MapInfo info;
  info.name = map.name().substr(map.name().rfind('/') + 1);
  info.title = map.display_name();
  info.revision = map.revision();
  info.num_frames = map.num_frames();
  info.num_objects = std::max<std::int64_t>(map.num_submaps() - 1, 0);
  info.voxel_size_m = map.config().voxel_size_m();
  for (const v1::LabelClass& its : map.label_classes()) info.classes.push_back(LabelOf(its));
  info.history_id = map.history_id();
  info.etag = map.etag();
  return info;
}

v1::LabelClass ToProto(const Label& label) {
  v1::LabelClass out;
  out.set_id(label.id);
  out.set_name(label.name);
  if (label.kind != Kind::kUnknown) {
    out.set_kind(label.kind == Kind::kThing ? v1::LabelClass::THING : v1::LabelClass::STUFF);
  }
  switch (label.size) {
    case Label::Size::kSmall: out.set_size(v1::LabelClass::SMALL); break;
    case Label::Size::kMedium: out.set_size(v1::LabelClass::MEDIUM); break;
    case Label::Size::kLarge: out.set_size(v1::LabelClass::LARGE); break;
  }
  return out;
}

}  // namespace dhpmap::client
