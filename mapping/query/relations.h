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
  kIn,      ///< the object encloses the subject; of several in each other the innermost
  kNextTo,  ///< beside each other, at one height; told once, the one of less id as the subject
};

/// What makes a relation; see resting.h, enclosure.h and free_way.h for how it is measured. Up is z of the asker's
/// frame.
struct RelationRules {
  // On: of the columns of the subject that anything holds up, the share that the object does.
  double least_support = 0.3;
  // In: what is below and above the subject counts a quarter each, what is around it half. A table under a cup has a
  // quarter, a shelf's boards, sides and back some 0.7 to 0.8.
  double least_enclosure = 0.65;
  // Next to: neither on nor in each other, nothing between, surfaces no farther apart, and heights that share so much
  // of the lower one.
  double most_gap_m = 0.5;
  double least_height_share = 0.5;
};

/// One thing to another, with the numbers that led to it; those that the relation does not ask for are 0.
struct Relation {
  RelationKind kind = RelationKind::kOn;
  const Submap* subject = nullptr;
  const Submap* object = nullptr;
  double support = 0;       ///< on: see RelationRules
  double enclosure = 0;     ///< in: likewise
  double gap_m = 0;         ///< between the surfaces, to half a voxel or so: of next to along a way with nothing on it
  double height_share = 0;  ///< next to: likewise
};

/// Where a relation stands among others.
struct RelationPlace {
  SubmapId subject, object;
  RelationKind kind = RelationKind::kOn;
  auto operator<=>(const RelationPlace&) const = default;
};

struct RelationQuestion {
  Transform T_map_query = Transform::Identity();  ///< from the asker's frame
  QueryScope scope;
  RelationRules rules;
  std::optional<SubmapId> submap;                  ///< only those with it as the subject or object
  std::optional<std::vector<RelationKind>> kinds;  ///< only these
  std::optional<RelationPlace> after;              ///< only those that come after it
  std::size_t most = 1000;                         ///< so many at most, those of least ids
};

/// By ascending subject, object and kind. Subjects are things, objects of `on` and `in` are things or stuff, of
/// `next to` things; the unknown submap is neither. Makes surfaces that are not there. Gives up, with what it has, soon
/// after `stop` is requested. What it refers to lasts as long as the surfaces.
std::vector<Relation> FindRelations(const MapSurfaces& surfaces, const RelationQuestion& question,
                                    const std::stop_token& stop = {});

}  // namespace dhpmap
