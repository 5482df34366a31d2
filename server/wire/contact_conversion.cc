// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/contact_conversion.h"

#include <string>

#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

Status BadRequest(const std::string& field, const std::string& what) {
  return InvalidArgument("the check is not possible").WithReason("BAD_POINTS").WithViolation(field, what);
}

bool HasClass(const BodyContact& contact) {
  return contact.submap != nullptr && contact.submap->panoptic != Panoptic::kUnknown;
}

}  // namespace

bool IsUsableSphere(const Eigen::Vector3d& center_m, double radius_m) {
  return center_m.cwiseAbs().maxCoeff() <= kMostReach_m && !center_m.hasNaN() && radius_m >= 0 &&
         radius_m <= kMostBody_m;
}

Result<std::size_t> MaxContactsFromProto(bool all_contacts, int max_contacts, bool packed) {
  if (!all_contacts) {
    if (max_contacts != 0) return BadRequest("max_contacts", "has no meaning without all_contacts");
    return std::size_t{1};
  }
  if (packed) return BadRequest("all_contacts", "arrays have room for one contact");
  if (max_contacts < 0 || max_contacts > kMostContacts) return BadRequest("max_contacts", "is not from 0 to 1,000");
  return static_cast<std::size_t>(max_contacts == 0 ? kDefaultContacts : max_contacts);
}

v1::Contact ToProto(const BodyContact& contact, const MapInfo& map) {
  v1::Contact proto;
  proto.set_depth_m(static_cast<float>(contact.depth_m));
  *proto.mutable_point_m() = ToProto(contact.point_m);
  proto.set_instance_id(InstanceOf(contact));
  if (contact.submap == nullptr) return proto;
  *proto.mutable_normal() = ToProto(contact.normal);
  proto.set_submap(SubmapResourceName(map.name, contact.submap->id));
  if (HasClass(contact)) {
    proto.set_class_id(contact.submap->class_id.value);
    if (const LabelClass* c = map.label_set->Find(contact.submap->class_id)) proto.set_class_name(c->name);
  }
  return proto;
}

std::int64_t InstanceOf(const BodyContact& contact) {
  return contact.submap == nullptr ? kNobodysId : std::int64_t{contact.submap->id.value};
}

std::int32_t ClassOf(const BodyContact& contact) {
  return HasClass(contact) ? std::int32_t{contact.submap->class_id.value} : kNoClass;
}

}  // namespace dhpmap
