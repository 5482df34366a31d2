// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/object_conversion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mapping/submap/display_name.h"
#include "server/app/states/no_such_submap.h"
#include "server/wire/query_options.h"
#include "server/wire/submap_conversion.h"
#include "server/wire/types/pose_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

constexpr int kDefaultMatches = 100, kMostMatches = 1000;
constexpr int kDefaultRelations = 1000, kMostRelations = 10'000;
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

Result<std::size_t> MostFromProto(int most, int by_default, int at_most) {
  if (most == 0) return static_cast<std::size_t>(by_default);
  if (most < 0 || most > at_most) return BadQuestion("most", "is not from 1 to " + std::to_string(at_most));
  return static_cast<std::size_t>(most);
}

Result<Eigen::AlignedBox3d> RegionFromProto(const v1::Box& region) {
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

/// One that may be left out.
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

}  // namespace

Result<SubmapQuestion> SubmapQuestionFromProto(const v1::SearchSubmapsRequest& request, const MapSnapshot& map) {
  SubmapQuestion question;
  if (request.name_part().size() > kMostName) return BadQuestion("name_part", "is longer than 200 bytes");
  question.name_part = request.name_part();
  if (request.has_region()) {
    DHPMAP_ASSIGN_OR_RETURN(question.box_m, RegionFromProto(request.region()));
  }
  if (request.has_sphere()) {
    DHPMAP_ASSIGN_OR_RETURN(question.sphere_m, SphereFromProto(request.sphere()));
  }
  if (request.has_near_m()) {
    DHPMAP_ASSIGN_OR_RETURN(question.near_m, PlaceFromProto(request.near_m(), "near_m"));
  }
  DHPMAP_ASSIGN_OR_RETURN(question.most, MostFromProto(request.most(), kDefaultMatches, kMostMatches));
  DHPMAP_ASSIGN_OR_RETURN(const auto options, QueryOptionsFromProto(request.options(), map, kObjectOptions));
  question.T_map_query = options.T_map_query;
  question.scope = options.options.scope;
  if (request.options().has_max_distance_m()) question.max_distance_m = options.options.max_distance_m;
  return question;
}

Result<RelationQuestion> RelationQuestionFromProto(const v1::ListRelationsRequest& request, const MapSnapshot& map) {
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
  DHPMAP_ASSIGN_OR_RETURN(question.most, MostFromProto(request.most(), kDefaultRelations, kMostRelations));
  DHPMAP_ASSIGN_OR_RETURN(const auto options, QueryOptionsFromProto(request.options(), map, kObjectOptions));
  question.T_map_query = options.T_map_query;
  question.scope = options.options.scope;
  return question;
}

void ToProto(const SubmapQuestion& question, std::span<const SubmapMatch> matches, const MapView& view,
             v1::SearchSubmapsResponse& response) {
  response.set_revision(view.snapshot().revision());
  for (const SubmapMatch& match : matches) {
    v1::SubmapMatch& proto = *response.add_matches();
    *proto.mutable_submap() = ToProto(*match.submap, view);
    if (!match.box_m.isEmpty()) {
      *proto.mutable_box()->mutable_min_m() = ToProto(Eigen::Vector3d(match.box_m.min()));
      *proto.mutable_box()->mutable_max_m() = ToProto(Eigen::Vector3d(match.box_m.max()));
    }
    if (!question.near_m) continue;
    proto.set_distance_m(match.distance_m);
    *proto.mutable_nearest_m() = ToProto(match.nearest_m);
  }
}

void ToProto(std::span<const Relation> relations, const MapInfo& map, v1::ListRelationsResponse& response) {
  response.set_revision(map.revision);
  for (const Relation& relation : relations) {
    v1::Relation& proto = *response.add_relations();
    proto.set_kind(KindToProto(relation.kind));
    proto.set_subject(SubmapResourceName(map.name, relation.subject->id()));
    proto.set_subject_display_name(DisplayNameOf(relation.subject->info(), *map.label_set));
    proto.set_object(SubmapResourceName(map.name, relation.object->id()));
    proto.set_object_display_name(DisplayNameOf(relation.object->info(), *map.label_set));
    proto.set_support(relation.support);
    proto.set_enclosure(relation.enclosure);
    proto.set_gap_m(relation.gap_m);
    proto.set_height_share(relation.height_share);
  }
}

std::size_t BytesOfAnswers(const v1::SearchSubmapsRequest& request) {
  constexpr std::size_t kMatch = 1200 + 600 + 1500;  // with its names; as bytes; both of a footprint of 30 corners
  const int most = request.most() > 0 ? std::min(request.most(), kMostMatches) : kDefaultMatches;
  return static_cast<std::size_t>(most) * kMatch;
}

std::size_t BytesOfAnswers(const v1::ListRelationsRequest& request) {
  constexpr std::size_t kRelation = 500 + 300;
  const int most = request.most() > 0 ? std::min(request.most(), kMostRelations) : kDefaultRelations;
  return static_cast<std::size_t>(most) * kRelation;
}

}  // namespace dhpmap
