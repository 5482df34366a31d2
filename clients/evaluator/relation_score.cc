// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/relation_score.h"

#include <algorithm>

namespace dhpmap::evaluator {
namespace {

double Share(std::int64_t part, std::int64_t rest) {
  return part + rest == 0 ? 1 : static_cast<double>(part) / static_cast<double>(part + rest);
}

/// Flags an id of the map that matches no object of the truth.
constexpr std::uint32_t kNoTruth = 1u << 31;

std::string Line(const char* what, const NamedRelation& relation, const RelationTruth& truth) {
  const auto name = [&truth](std::uint32_t id) {
    const auto found = truth.names.find(id);
    return found != truth.names.end() ? found->second : "submap " + std::to_string(id & ~kNoTruth);
  };
  const auto& [kind, subject, object] = relation;
  return std::string(what) + ": " + name(subject) + " " + NameOf(kind) + " " + name(object);
}

}  // namespace

double RelationScore::Precision() const { return Share(num_right, num_wrong); }
double RelationScore::Recall() const { return Share(num_right, num_missed); }

std::map<std::uint32_t, std::uint32_t> MatchByPlaces(const SharedPlaces& shared) {
  std::map<std::uint32_t, std::int64_t> of_truth, of_map;
  for (const auto& [pair, num_places] : shared) {
    of_truth[pair.first] += num_places;
    of_map[pair.second] += num_places;
  }
  std::map<std::uint32_t, std::uint32_t> stands_for;
  for (const auto& [pair, num_places] : shared) {
    const auto& [truth, map] = pair;
    if (truth == 0 || map == 0 || 2 * num_places <= of_truth[truth] || 2 * num_places <= of_map[map]) continue;
    stands_for[map] = truth;
  }
  return stands_for;
}

std::map<RelationKind, RelationScore> ScoreRelations(const RelationTruth& truth,
                                                     const std::vector<NamedRelation>& told_of_map,
                                                     const std::map<std::uint32_t, std::uint32_t>& stands_for,
                                                     bool only_matched, std::vector<std::string>* mistakes) {
  std::set<std::uint32_t> matched;
  for (const auto& [map, id] : stands_for) matched.insert(id);
  std::set<NamedRelation> told;
  for (const auto& [kind, subject, object] : told_of_map) {
    const auto s = stands_for.find(subject), o = stands_for.find(object);
    if (only_matched && (s == stands_for.end() || o == stands_for.end())) continue;
    told.insert(MakeNamedRelation(kind, s != stands_for.end() ? s->second : subject | kNoTruth,
                                  o != stands_for.end() ? o->second : object | kNoTruth));
  }
  std::map<RelationKind, RelationScore> scores;
  for (const NamedRelation& relation : told) {
    RelationScore& score = scores[std::get<0>(relation)];
    const bool is_right = truth.relations.contains(relation);
    ++(is_right ? score.num_right : score.num_wrong);
    if (!is_right && mistakes != nullptr) mistakes->push_back(Line("wrong", relation, truth));
  }
  for (const NamedRelation& relation : truth.relations) {
    const auto& [kind, subject, object] = relation;
    if (told.contains(relation)) continue;
    if (only_matched && (!matched.contains(subject) || !matched.contains(object))) continue;
    ++scores[kind].num_missed;
    if (mistakes != nullptr) mistakes->push_back(Line("missed", relation, truth));
  }
  return scores;
}

}  // namespace dhpmap::evaluator
