// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/object_conversion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mapping/submap/display_name.h"
#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"
#include "server/app/states/no_such_submap.h"
#include "server/wire/object_pages.h"
#include "server/wire/query_options.h"
#include "server/wire/submap_conversion.h"

namespace dhpmap {
namespace {

constexpr double kMostGap_m = 10;
constexpr std::size_t kMostName = 200;
constexpr TakenOptions kObjectOptions{.attached = true};

Status BadQuestion(const std::string& field, const std::string& what) {
  return InvalidArgument("the objects cannot be looked for").WithReason("BAD_FILTER").WithViolation(field, what);
}

Result<Eigen::Vector3d> PlaceFromProto(const v1::Vector3& place, const std::string& field) {
  const Eigen::Vector3d p = VectorFromProto(place);
  if (!(p.array().abs() <= kReach_m).all()) return BadQuestion(field, "is not within 1,000,000 m");
  return p;
}

Result<Eigen::AlignedBox3d> RegionFromProto(const v1::AxisAlignedBox& region) {
  DHPMAP_ASSIGN_OR_RETURN(const Eigen::Vector3d low, PlaceFromProto(region.min_m(), "region.min_m"));
  DHPMAP_ASSIGN_OR_RETURN(const Eigen::Vector3d high, PlaceFromProto(region.max_m(), "region.max_m"));
  if (!(low.array() <= high.array()).all()) return BadQuestion("region.max_m", "is below min_m");
  return Eigen::AlignedBox3d(low, high);
}

Result<BoundingSphere> SphereFromProto(const v1::Sphere& sphere) {
  DHPMAP_ASSIGN_OR_RETURN(const Eigen::Vector3d center_m, PlaceFromProto(sphere.center_m(), "sphere.center_m"));
  if (!(sphere.radius_m() >= 0 && sphere.radius_m() <= kReach_m)) {
    return BadQuestion("sphere.radius_m", "is not from 0 to 1,000,000");
  }
  return BoundingSphere{center_m, sphere.radius_m()};
}

std::size_t NumAsked(int page_size, PageSizes sizes) {
  return static_cast<std::size_t>(page_size > 0 ? std::min(page_size, sizes.at_most) : sizes.by_default);
}

/// Reads an optional number.
Status TakeNumber(bool is_given, double value, double most, const std::string& field, double& number) {
  if (!is_given) return Status::Ok();
  number = value;
  if (value > 0 && value <= most) return Status::Ok();
  return BadQuestion(field, "is not above 0 and up to " + std::to_string(static_cast<int>(most)));
}

Result<RelationKind> KindFromProto(int kind, const std::string& field) {
  switch (kind) {
    case v1::Relation::ON: return RelationKind::kOn;
    case v1::Relation::IN: return RelationKind::kIn;
    case v1::Relation::NEXT_TO: return RelationKind::kNextTo;
    default: return BadQuestion(field, "is none of those there are");
  }
}

v1::Relation::Kind KindToProto(RelationKind kind) {
  switch (kind) {
    case RelationKind::kOn: return v1::Relation::ON;
    case RelationKind::kIn: return v1::Relation::IN;
    case RelationKind::kNextTo: return v1::Relation::NEXT_TO;
  }
  return v1::Relation::KIND_UNSPECIFIED;
}

Result<SubmapId> SubjectFromProto(const std::string& name, const MapSnapshot& map) {
  DHPMAP_ASSIGN_OR_RETURN(const SubmapName parsed, ParseSubmapName(name, "submap"));
  if (parsed.map != map.info().name) return BadQuestion("submap", "is a submap of another map");
  if (map.Find(parsed.submap) == nullptr) {
    return NoSuchSubmap(map.info(), parsed.submap).WithViolation("submap", "is not there");
  }
  return parsed.submap;
}

v1::SubmapMatch MatchToProto(const SubmapMatch& match, bool is_near_point, const MapView& view) {
  v1::SubmapMatch proto;
  *proto.mutable_submap() = ToProto(*match.submap, view);
  if (!match.box_m.isEmpty()) {
    *proto.mutable_box()->mutable_min_m() = ToProto(Eigen::Vector3d(match.box_m.min()));
    *proto.mutable_box()->mutable_max_m() = ToProto(Eigen::Vector3d(match.box_m.max()));
  }
  if (!is_near_point) return proto;
  proto.set_distance_m(match.distance_m);
  *proto.mutable_nearest_point_m() = ToProto(match.nearest_m);
  return proto;
}

v1::Relation RelationToProto(const Relation& relation, const MapInfo& map) {
  v1::Relation proto;
  proto.set_kind(KindToProto(relation.kind));
  proto.set_subject(SubmapResourceName(map.name, relation.subject->id()));
  proto.set_subject_display_name(DisplayNameOf(relation.subject->info(), *map.label_set));
  proto.set_object(SubmapResourceName(map.name, relation.object->id()));
  proto.set_object_display_name(DisplayNameOf(relation.object->info(), *map.label_set));
  proto.set_support(relation.support);
  proto.set_enclosure(relation.enclosure);
  proto.set_gap_m(relation.gap_m);
  proto.set_height_fraction(relation.height_share);
  return proto;
}

}  // namespace

Result<SubmapQuestion> SubmapQuestionFromProto(const v1::SearchSubmapsRequest& request, const MapSnapshot& map,
                                               const Pager& pager) {
  SubmapQuestion question;
  if (request.name_part().size() > kMostName) return BadQuestion("name_part", "is longer than 200 bytes");
  question.name_part = request.name_part();
  if (request.has_region()) {
    DHPMAP_ASSIGN_OR_RETURN(question.box_m, RegionFromProto(request.region()));
  }
  if (request.has_sphere()) {
    DHPMAP_ASSIGN_OR_RETURN(question.sphere_m, SphereFromProto(request.sphere()));
  }
  if (request.has_near_point_m()) {
    DHPMAP_ASSIGN_OR_RETURN(question.near_m, PlaceFromProto(request.near_point_m(), "near_point_m"));
  }
  question.most = pager.num_wanted();
  DHPMAP_ASSIGN_OR_RETURN(question.after, MatchFromPage(pager));
  DHPMAP_ASSIGN_OR_RETURN(const auto options, QueryOptionsFromProto(request.options(), map, kObjectOptions));
  question.T_map_query = options.T_map_query;
  question.scope = options.options.scope;
  if (request.options().has_max_distance_m()) question.max_distance_m = options.options.max_distance_m;
  return question;
}

Result<RelationQuestion> RelationQuestionFromProto(const v1::QueryRelationsRequest& request, const MapSnapshot& map,
                                                   const Pager& pager) {
  RelationQuestion question;
  RelationRules& rules = question.rules;
  if (!request.submap().empty()) {
    DHPMAP_ASSIGN_OR_RETURN(question.submap, SubjectFromProto(request.submap(), map));
  }
  for (int i = 0; i < request.kinds_size(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const RelationKind kind,
                            KindFromProto(request.kinds(i), "kinds[" + std::to_string(i) + "]"));
    if (!question.kinds) question.kinds.emplace();
    question.kinds->push_back(kind);
  }
  DHPMAP_RETURN_IF_ERROR(
      TakeNumber(request.has_max_gap_m(), request.max_gap_m(), kMostGap_m, "max_gap_m", rules.most_gap_m));
  DHPMAP_RETURN_IF_ERROR(
      TakeNumber(request.has_min_support(), request.min_support(), 1, "min_support", rules.least_support));
  DHPMAP_RETURN_IF_ERROR(
      TakeNumber(request.has_min_enclosure(), request.min_enclosure(), 1, "min_enclosure", rules.least_enclosure));
  question.most = pager.num_wanted();
  DHPMAP_ASSIGN_OR_RETURN(question.after, RelationFromPage(pager));
  DHPMAP_ASSIGN_OR_RETURN(const auto options, QueryOptionsFromProto(request.options(), map, kObjectOptions));
  question.T_map_query = options.T_map_query;
  question.scope = options.options.scope;
  return question;
}

void ToProto(const SubmapQuestion& question, std::span<const SubmapMatch> matches, const MapView& view, Pager& pager,
             v1::SearchSubmapsResponse& response) {
  response.set_revision(view.snapshot().revision());
  for (const SubmapMatch& match : matches) {
    v1::SubmapMatch proto = MatchToProto(match, question.near_m.has_value(), view);
    if (!pager.Takes(proto, KeyOf(match))) break;
    *response.add_matches() = std::move(proto);
  }
  response.set_next_page_token(pager.NextToken());
}

void ToProto(std::span<const Relation> relations, const MapInfo& map, Pager& pager,
             v1::QueryRelationsResponse& response) {
  response.set_revision(map.revision);
  for (const Relation& relation : relations) {
    v1::Relation proto = RelationToProto(relation, map);
    if (!pager.Takes(proto, KeyOf(relation))) break;
    *response.add_relations() = std::move(proto);
  }
  response.set_next_page_token(pager.NextToken());
}

std::size_t BytesOfAnswers(const v1::SearchSubmapsRequest& request) {
  constexpr std::size_t kMatch = 1200 + 600 + 1500;  // message, encoding, both of a footprint of 30 corners
  return NumAsked(request.page_size(), kMatchPages) * kMatch;
}

std::size_t BytesOfAnswers(const v1::QueryRelationsRequest& request) {
  constexpr std::size_t kRelation = 500 + 300;
  return NumAsked(request.page_size(), kRelationPages) * kRelation;
}

}  // namespace dhpmap
