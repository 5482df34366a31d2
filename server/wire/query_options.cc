// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/query_options.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "proto/types/pose_conversion.h"
#include "server/wire/option_fields.h"

namespace dhpmap {
namespace {

constexpr double kMaxDistance_m = 1000;
constexpr double kMaxPadding_m = 10;
constexpr int kMaxAttached = 100;
constexpr std::size_t kMostPaddings = 16;  // each costs a search for every point

Result<std::vector<ClassId>> ClassesFromProto(const google::protobuf::RepeatedPtrField<std::string>& names,
                                              const std::string& list, const LabelSet& label_set) {
  DHPMAP_RETURN_IF_ERROR(CheckOptionLength(list, names.size()));
  std::vector<ClassId> ids;
  for (int i = 0; i < names.size(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const ClassId id, OptionClassFromProto(names[i], ItemOfOption(list, i), label_set));
    ids.push_back(id);
  }
  return ids;
}

Result<double> PaddingFromProto(double padding_m, const std::string& field) {
  if (padding_m >= 0 && padding_m <= kMaxPadding_m) return padding_m;
  return BadOption("BAD_DISTANCE", field, "is not from 0 to 10");
}

Result<SurfacePadding> PaddingFromProto(const v1::Padding& proto, const MapSnapshot& map) {
  SurfacePadding padding;
  DHPMAP_ASSIGN_OR_RETURN(padding.default_m,
                          PaddingFromProto(proto.default_padding_m(), "options.padding.default_padding_m"));
  std::set<double> different = {padding.default_m};
  const std::string classes = "options.padding.classes", submaps = "options.padding.submaps";
  DHPMAP_RETURN_IF_ERROR(CheckOptionLength(classes, proto.classes_size()));
  for (int i = 0; i < proto.classes_size(); ++i) {
    const std::string item = ItemOfOption(classes, i);
    DHPMAP_ASSIGN_OR_RETURN(const ClassId id, OptionClassFromProto(proto.classes(i).class_name(), item + ".class_name",
                                                                   *map.info().label_set));
    DHPMAP_ASSIGN_OR_RETURN(const double padding_m,
                            PaddingFromProto(proto.classes(i).padding_m(), item + ".padding_m"));
    padding.classes.emplace_back(id, padding_m);
    different.insert(padding_m);
  }
  DHPMAP_RETURN_IF_ERROR(CheckOptionLength(submaps, proto.submaps_size()));
  for (int i = 0; i < proto.submaps_size(); ++i) {
    const std::string item = ItemOfOption(submaps, i);
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, OptionSubmapFromProto(proto.submaps(i).submap(), item + ".submap", map));
    DHPMAP_ASSIGN_OR_RETURN(const double padding_m,
                            PaddingFromProto(proto.submaps(i).padding_m(), item + ".padding_m"));
    padding.submaps.emplace_back(id, padding_m);
    different.insert(padding_m);
  }
  if (different.size() > kMostPaddings) {
    return BadOption("BAD_FILTER", "options.padding",
                     std::to_string(different.size()) + " different values are more than 16");
  }
  return padding;
}

Result<std::vector<SubmapId>> AttachedFromProto(const v1::QueryOptions& options, const MapSnapshot& map) {
  const std::string list = "options.attached";
  if (options.attached_size() > kMaxAttached) {
    return BadOption("BAD_FILTER", list, std::to_string(options.attached_size()) + " are more than 100");
  }
  std::vector<SubmapId> attached;
  for (int i = 0; i < options.attached_size(); ++i) {
    const std::string field = ItemOfOption(list, i) + ".submap";
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, OptionSubmapFromProto(options.attached(i).submap(), field, map));
    if (id == kUnknownSubmap) return BadOption("BAD_FILTER", field, "is that of unknown objects, which nobody carries");
    if (std::find(attached.begin(), attached.end(), id) != attached.end()) {
      return BadOption("BAD_FILTER", field, "is attached already");
    }
    attached.push_back(id);
  }
  return attached;
}

Result<QueryScope> ScopeFromProto(const v1::QueryOptions& options, const MapSnapshot& map) {
  const LabelSet& label_set = *map.info().label_set;
  QueryScope scope;
  DHPMAP_RETURN_IF_ERROR(CheckOptionLength("options.excluded_submaps", options.excluded_submaps_size()));
  for (int i = 0; i < options.excluded_submaps_size(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, OptionSubmapFromProto(options.excluded_submaps(i),
                                                                     ItemOfOption("options.excluded_submaps", i), map));
    scope.excluded_submaps.push_back(id);
  }
  DHPMAP_ASSIGN_OR_RETURN(scope.excluded_classes,
                          ClassesFromProto(options.excluded_class_names(), "options.excluded_class_names", label_set));
  if (options.class_names_size() > 0) {
    DHPMAP_ASSIGN_OR_RETURN(scope.classes, ClassesFromProto(options.class_names(), "options.class_names", label_set));
  }
  DHPMAP_ASSIGN_OR_RETURN(scope.attached, AttachedFromProto(options, map));
  DHPMAP_ASSIGN_OR_RETURN(scope.padding, PaddingFromProto(options.padding(), map));
  if (options.has_max_free_age_s()) {
    if (!(options.max_free_age_s() >= 0)) return BadOption("BAD_FILTER", "options.max_free_age_s", "is not 0 or more");
    scope.max_free_age_s = options.max_free_age_s();
  }
  scope.vacated_is_free = options.vacated_policy() == v1::Vacated::FREE;
  scope.keeps_attached_unknown = options.vacated_policy() == v1::Vacated::UNKNOWN;
  scope.with_absent = options.include_absent();
  return scope;
}

Status CheckTaken(const v1::QueryOptions& options, TakenOptions taken) {
  if (options.min_revision() < 0) return BadOption("BAD_FILTER", "options.min_revision", "is negative");
  if (!v1::QueryOptions::UnknownPolicy_IsValid(options.unknown_policy())) {
    return BadOption("BAD_FILTER", "options.unknown_policy", "is none of those there are");
  }
  if (options.unknown_policy() == v1::QueryOptions::OCCUPIED && !taken.occupied) {
    return NotTaken("options.unknown_policy");
  }
  if (options.has_padding() && !taken.padding) return NotTaken("options.padding");
  if (options.attached_size() > 0 && !taken.attached) return NotTaken("options.attached");
  for (int i = 0; i < options.attached_size() && !taken.carries; ++i) {
    if (options.attached(i).has_robot_from_submap())
      return NotTaken(ItemOfOption("options.attached", i) + ".robot_from_submap");
  }
  if (options.allowed_collisions_size() > 0 && !taken.allowed) return NotTaken("options.allowed_collisions");
  if (options.has_max_free_age_s() && !taken.max_age) return NotTaken("options.max_free_age_s");
  if (!v1::Vacated::Policy_IsValid(options.vacated_policy())) {
    return BadOption("BAD_FILTER", "options.vacated_policy", "is none of those there are");
  }
  if (options.vacated_policy() != v1::Vacated::POLICY_UNSPECIFIED && !taken.vacated)
    return NotTaken("options.vacated_policy");
  if (options.has_tolerance_vox() && !taken.tolerance) return NotTaken("options.tolerance_vox");
  return Status::Ok();
}

/// The search radius; 3 m by default.
Result<double> MaxDistanceFromProto(const v1::QueryOptions& options) {
  if (!options.has_max_distance_m()) return 3.0;
  const double distance_m = options.max_distance_m();
  if (distance_m > 0 && distance_m <= kMaxDistance_m) return distance_m;
  return BadOption("BAD_DISTANCE", "options.max_distance_m", "is not above 0 and up to 1,000");
}

UnknownSpace UnknownSpaceOf(v1::QueryOptions::UnknownPolicy policy) {
  if (policy == v1::QueryOptions::FREE) return UnknownSpace::kFree;
  return policy == v1::QueryOptions::REPORT ? UnknownSpace::kReported : UnknownSpace::kOccupied;
}

/// The attached objects with their poses. `ids` are those of options.attached.
Result<std::vector<AttachedSubmap>> CarriedFromProto(const v1::QueryOptions& options,
                                                     const std::vector<SubmapId>& ids) {
  std::vector<AttachedSubmap> carried;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int item = static_cast<int>(i);
    AttachedSubmap& one = carried.emplace_back(AttachedSubmap{.submap = ids[i], .may_touch = {}});
    DHPMAP_ASSIGN_OR_RETURN(one.T_robot_submap,
                            TransformFromProto(options.attached(item).robot_from_submap(),
                                               ItemOfOption("options.attached", item) + ".robot_from_submap"));
  }
  return carried;
}

}  // namespace

Result<DistanceQuestion> QueryOptionsFromProto(const v1::QueryOptions& options, const MapSnapshot& map,
                                               TakenOptions taken) {
  DHPMAP_RETURN_IF_ERROR(CheckTaken(options, taken));
  DistanceQuestion question;
  question.options.unknown_is_free = options.unknown_policy() == v1::QueryOptions::FREE;
  DHPMAP_ASSIGN_OR_RETURN(question.options.max_distance_m, MaxDistanceFromProto(options));
  if (!(options.tolerance_vox() >= 0)) return BadOption("BAD_FILTER", "options.tolerance_vox", "is not 0 or more");
  question.options.tolerance_vox = options.tolerance_vox();
  DHPMAP_ASSIGN_OR_RETURN(question.options.scope, ScopeFromProto(options, map));
  DHPMAP_ASSIGN_OR_RETURN(question.T_map_query, TransformFromProto(options.map_from_query(), "options.map_from_query"));
  return question;
}

Result<Transform> FrameOptionsFromProto(const v1::QueryOptions& options) {
  std::vector<const google::protobuf::FieldDescriptor*> given;
  options.GetReflection()->ListFields(options, &given);
  for (const google::protobuf::FieldDescriptor* field : given) {
    const int number = field->number();
    if (number != v1::QueryOptions::kMapFromQueryFieldNumber && number != v1::QueryOptions::kMinRevisionFieldNumber) {
      return NotTaken("options." + field->name());
    }
  }
  if (options.min_revision() < 0) return BadOption("BAD_FILTER", "options.min_revision", "is negative");
  return TransformFromProto(options.map_from_query(), "options.map_from_query");
}

Result<CheckQuestion> CheckOptionsFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                            const MapSnapshot& map, TakenOptions taken) {
  DHPMAP_RETURN_IF_ERROR(CheckTaken(options, taken));
  CheckQuestion question;
  question.options.unknown = UnknownSpaceOf(options.unknown_policy());
  DHPMAP_ASSIGN_OR_RETURN(question.options.max_distance_m, MaxDistanceFromProto(options));
  DHPMAP_ASSIGN_OR_RETURN(question.options.scope, ScopeFromProto(options, map));
  const std::vector<SubmapId>& attached = question.options.scope.attached;
  DHPMAP_ASSIGN_OR_RETURN(question.attached, CarriedFromProto(options, attached));
  DHPMAP_ASSIGN_OR_RETURN(
      AllowedTouches allowed,
      AllowedTouchesFromProto(options, links, taken.carries ? attached : std::vector<SubmapId>(), map));
  question.parts = std::move(allowed.parts);
  for (std::size_t i = 0; i < allowed.attached.size(); ++i) question.attached[i].may_touch = allowed.attached[i];
  DHPMAP_ASSIGN_OR_RETURN(question.T_map_query, TransformFromProto(options.map_from_query(), "options.map_from_query"));
  return question;
}

}  // namespace dhpmap
