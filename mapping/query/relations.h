// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/query/query_scope.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

enum class RelationKind : std::uint8_t {
  kOn,      ///< the subject rests on the object
  kIn,      ///< the object encloses the subject; for nested objects, the innermost
  kNextTo,  ///< adjacent, at one height; reported once, with the smaller id as the subject
};

/// Thresholds of relations; resting.h, enclosure.h and free_way.h define the measures. Up is z of the query's frame.
struct RelationRules {
  // On: share of the subject's supported columns that the object supports.
  double least_support = 0.3;
  // In: enclosure below and above the subject counts a quarter each, around it half. A table under a cup gives a
  // quarter; boards, sides and back of a shelf about 0.7 to 0.8.
  double least_enclosure = 0.65;
  // Next to: neither on nor in each other, nothing in between, a maximum gap of the surfaces, and a minimum overlap in
  // height, as a share of the lower one.
  double most_gap_m = 0.5;
  double least_height_share = 0.5;
};

/// A relation of two objects, with its measures; those that do not apply are 0.
struct Relation {
  RelationKind kind = RelationKind::kOn;
  const Submap* subject = nullptr;
  const Submap* object = nullptr;
  double support = 0;       ///< on: see RelationRules
  double enclosure = 0;     ///< in: likewise
  double gap_m = 0;         ///< between the surfaces, within about half a voxel; for next to along an unobstructed line
  double height_share = 0;  ///< next to: likewise
};

/// Position of a relation in the order, for paging.
struct RelationPlace {
  SubmapId subject, object;
  RelationKind kind = RelationKind::kOn;
  auto operator<=>(const RelationPlace&) const = default;
};

struct RelationQuestion {
  Transform T_map_query = Transform::Identity();  ///< transform of the query's frame
  QueryScope scope;
  RelationRules rules;
  std::optional<SubmapId> submap;                  ///< only relations with it as subject or object
  std::optional<std::vector<RelationKind>> kinds;  ///< only these kinds
  std::optional<RelationPlace> after;              ///< only relations after this position
  std::size_t most = 1000;                         ///< limit; the first in the order
};

/// By ascending subject, object and kind. Subjects are things; objects of `on` and `in` are things or stuff, of `next
/// to` things; never the unknown submap. Computes missing surfaces. Returns partial results soon after a `stop`
/// request. References are valid as long as the surfaces.
std::vector<Relation> FindRelations(const MapSurfaces& surfaces, const RelationQuestion& question,
                                    const std::stop_token& stop = {});

}  // namespace dhpmap
