// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clients/evaluator/relation_truth.h"

namespace dhpmap::evaluator {

/// How many labelled places are of an object of the truth and of a map, by their ids.
using SharedPlaces = std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t>;

/// By id of the map the object of the truth that it stands for: those that share more than half of the places of each.
std::map<std::uint32_t, std::uint32_t> MatchByPlaces(const SharedPlaces& shared);

/// What a map tells against what is true.
struct RelationScore {
  std::int64_t num_right = 0, num_wrong = 0, num_missed = 0;
  [[nodiscard]] double Precision() const;  ///< 1 if nothing is told
  [[nodiscard]] double Recall() const;     ///< 1 if there is nothing to tell
};

/// By kind. Relations of what stands for nothing are wrong, and those of what nothing stands for are missed, unless
/// `only_matched`, which leaves both out. `mistakes`, if not null, gets a line for each.
std::map<RelationKind, RelationScore> ScoreRelations(const RelationTruth& truth,
                                                     const std::vector<NamedRelation>& told_of_map,
                                                     const std::map<std::uint32_t, std::uint32_t>& stands_for,
                                                     bool only_matched, std::vector<std::string>* mistakes);

}  // namespace dhpmap::evaluator
