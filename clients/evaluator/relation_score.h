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

/// Number of labelled places shared by an object of the truth and one of a map, by their ids.
using SharedPlaces = std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t>;

/// Maps ids of the map to objects of the truth that share more than half of the places of each.
std::map<std::uint32_t, std::uint32_t> MatchByPlaces(const SharedPlaces& shared);

/// A map's relations compared with the true ones.
struct RelationScore {
  std::int64_t num_right = 0, num_wrong = 0, num_missed = 0;
  [[nodiscard]] double Precision() const;  ///< 1 without any reported relation
  [[nodiscard]] double Recall() const;     ///< 1 without any true relation
};

/// Scores by kind. Relations of unmatched objects of the map are wrong, those of unmatched objects of the truth missed;
/// with `only_matched` both are ignored. `mistakes`, if not null, gets a line for each mistake.
std::map<RelationKind, RelationScore> ScoreRelations(const RelationTruth& truth,
                                                     const std::vector<NamedRelation>& told_of_map,
                                                     const std::map<std::uint32_t, std::uint32_t>& stands_for,
                                                     bool only_matched, std::vector<std::string>* mistakes);

}  // namespace dhpmap::evaluator
