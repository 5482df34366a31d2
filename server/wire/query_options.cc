// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/query_options.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "server/wire/types/pose_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

constexpr double kMaxDistance_m = 1000;
constexpr int kMaxListed = 1000;

Status BadOption(Reason reason, const std::string& field, const std::string& what) {
  return InvalidArgument("the options of the query are not usable").WithReason(reason).WithViolation(field, what);
}

std::string Item(const std::string& list, int number) { return list + "[" + std::to_string(number) + "]"; }

Status CheckLength(const std::string& list, int length) {
  if (length <= kMaxListed) return Status::Ok();
  return BadOption("BAD_FILTER", list, std::to_string(length) + " are more than " + std::to_string(kMaxListed));
}

Result<SubmapId> SubmapFromProto(const std::string& name, const std::string& field, const MapSnapshot& map) {
  DHPMAP_ASSIGN_OR_RETURN(const SubmapName parsed, ParseSubmapName(name, field));
  if (parsed.map != map.info().name) return BadOption("BAD_FILTER", field, "is a submap of another map");
  if (map.Find(parsed.submap) == nullptr) {
    return NotFound("there is no submap " + std::to_string(parsed.submap.value))
        .WithReason("SUBMAP_NOT_FOUND")
        .WithViolation(field, "is not there");
  }
  return parsed.submap;
}

Result<std::vector<ClassId>> ClassesFromProto(const google::protobuf::RepeatedPtrField<std::string>& names,
                                              const std::string& list, const LabelSet& label_set) {
  DHPMAP_RETURN_IF_ERROR(CheckLength(list, names.size()));
  std::vector<ClassId> ids;
  for (int i = 0; i < names.size(); ++i) {
    const auto& classes = label_set.classes();
    const auto found = std::find_if(classes.begin(), classes.end(), [&](const auto& c) { return c.name == names[i]; });
    if (found == classes.end()) {
      return BadOption("BAD_FILTER", Item(list, i), "the label set has no class '" + names[i].substr(0, 80) + "'");
    }
    ids.push_back(found->id);
  }
  return ids;
}

Result<QueryScope> ScopeFromProto(const v1::QueryOptions& options, const MapSnapshot& map) {
  const LabelSet& label_set = *map.info().label_set;
  QueryScope scope;
  DHPMAP_RETURN_IF_ERROR(CheckLength("options.excluded_submaps", options.excluded_submaps_size()));
  for (int i = 0; i < options.excluded_submaps_size(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id,
                            SubmapFromProto(options.excluded_submaps(i), Item("options.excluded_submaps", i), map));
    scope.excluded_submaps.push_back(id);
  }
  DHPMAP_ASSIGN_OR_RETURN(scope.excluded_classes,
                          ClassesFromProto(options.excluded_class_names(), "options.excluded_class_names", label_set));
  if (options.class_names_size() > 0) {
    DHPMAP_ASSIGN_OR_RETURN(scope.classes, ClassesFromProto(options.class_names(), "options.class_names", label_set));
  }
  return scope;
}

}  // namespace

Result<DistanceQuestion> QueryOptionsFromProto(const v1::QueryOptions& options, const MapSnapshot& map) {
  DistanceQuestion question;
  switch (options.unknown_policy()) {
    case v1::QueryOptions::UNKNOWN_POLICY_UNSPECIFIED:
    case v1::QueryOptions::REPORT: break;
    case v1::QueryOptions::FREE: question.options.unknown_is_free = true; break;
    default: return BadOption("BAD_FILTER", "options.unknown_policy", "is none of those there are");
  }
  if (options.has_max_distance_m()) {
    const double distance_m = options.max_distance_m();
    if (!(distance_m > 0 && distance_m <= kMaxDistance_m)) {
      return BadOption("BAD_DISTANCE", "options.max_distance_m", "is not above 0 and up to 1,000");
    }
    question.options.max_distance_m = distance_m;
  }
  DHPMAP_ASSIGN_OR_RETURN(question.options.scope, ScopeFromProto(options, map));
  DHPMAP_ASSIGN_OR_RETURN(question.T_map_query, TransformFromProto(options.frame(), "options.frame"));
  return question;
}

}  // namespace dhpmap
