// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/options.h"

#include "clients/cpp/src/convert/geometry.h"

namespace dhpmap::client {
namespace {

v1::QueryOptions::UnknownPolicy PolicyOf(Unknown unknown) {
  switch (unknown) {
    case Unknown::kReport: return v1::QueryOptions::REPORT;
    case Unknown::kFree: return v1::QueryOptions::FREE;
    case Unknown::kOccupied: return v1::QueryOptions::OCCUPIED;
    case Unknown::kDefault: break;
  }
  return v1::QueryOptions::UNKNOWN_POLICY_UNSPECIFIED;
}

void AddIgnored(const ObjectOrClass& ignored, const std::string& map, v1::QueryOptions& out) {
  if (const auto* id = std::get_if<std::int64_t>(&ignored)) out.add_excluded_submaps(SubmapName(map, *id));
  else out.add_excluded_class_names(std::get<std::string>(ignored));
}

void AddPadding(const Padding& padding, const std::string& map, v1::Padding& out) {
  if (const auto* id = std::get_if<std::int64_t>(&padding.of)) {
    v1::SubmapPadding& its = *out.add_submaps();
    its.set_submap(SubmapName(map, *id));
    its.set_padding_m(padding.padding_m);
  } else {
    v1::ClassPadding& its = *out.add_classes();
    its.set_class_name(std::get<std::string>(padding.of));
    its.set_padding_m(padding.padding_m);
  }
}

void AddMayTouch(const MayTouch& may_touch, const std::string& map, v1::QueryOptions& out) {
  for (const ObjectOrClass& thing : may_touch.things) {
    v1::AllowedCollision& allowed = *out.add_allowed_collisions();
    allowed.set_link(may_touch.link);
    if (may_touch.attached) allowed.set_attached(SubmapName(map, *may_touch.attached));
    if (const auto* id = std::get_if<std::int64_t>(&thing)) allowed.set_submap(SubmapName(map, *id));
    else allowed.set_class_name(std::get<std::string>(thing));
  }
}

}  // namespace

v1::QueryOptions ToProto(const QueryOptions& options, const std::string& map,
                         std::span<const ObjectOrClass> may_touch) {
  v1::QueryOptions out;
  out.set_unknown_policy(PolicyOf(options.unknown));
  if (options.vacated == Vacated::kUnknown) out.set_vacated_policy(v1::Vacated::UNKNOWN);
  if (options.vacated == Vacated::kFree) out.set_vacated_policy(v1::Vacated::FREE);
  if (options.max_distance_m) out.set_max_distance_m(*options.max_distance_m);
  if (options.max_free_age_s) out.set_max_free_age_s(*options.max_free_age_s);
  if (options.tolerance_vox != 0) out.set_tolerance_vox(options.tolerance_vox);
  if (options.T_map_query) *out.mutable_map_from_query() = ToProto(*options.T_map_query);
  out.set_include_absent(options.include_absent);
  out.set_min_revision(options.min_revision);
  for (const ObjectOrClass& ignored : options.ignore) AddIgnored(ignored, map, out);
  for (const std::string& name : options.classes) out.add_class_names(name);
  if (options.padding_m != 0) out.mutable_padding()->set_default_padding_m(options.padding_m);
  for (const Padding& padding : options.padding_of) AddPadding(padding, map, *out.mutable_padding());
  for (const Attached& attached : options.attached) {
    v1::AttachedSubmap& its = *out.add_attached();
    its.set_submap(SubmapName(map, attached.object));
    if (attached.T_robot_object) *its.mutable_robot_from_submap() = ToProto(*attached.T_robot_object);
  }
  for (const MayTouch& its : options.may_touch) AddMayTouch(its, map, out);
  AddMayTouch({.things = {may_touch.begin(), may_touch.end()}}, map, out);
  return out;
}

}  // namespace dhpmap::client
