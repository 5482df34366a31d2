// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "dhpmap/v1/search.pb.h"
#include "mapping/query/relations.h"
#include "mapping/query/submap_search.h"
#include "server/app/states/map_view.h"
#include "server/wire/paging.h"

namespace dhpmap {

inline constexpr PageSizes kMatchPages{.by_default = 100, .at_most = 1000};
inline constexpr PageSizes kRelationPages{.by_default = 1000, .at_most = 10'000};

// Queries about objects, for the page of the pager. INVALID_ARGUMENT, naming the field, for an invalid name, place,
// number, kind or page token, NOT_FOUND for a missing submap; errors of QueryOptionsFromProto.
Result<SubmapQuestion> SubmapQuestionFromProto(const v1::SearchSubmapsRequest& request, const MapSnapshot& map,
                                               const Pager& pager);
Result<RelationQuestion> RelationQuestionFromProto(const v1::QueryRelationsRequest& request, const MapSnapshot& map,
                                                   const Pager& pager);

// The page of answers to such a query.
void ToProto(const SubmapQuestion& question, std::span<const SubmapMatch> matches, const MapView& view, Pager& pager,
             v1::SearchSubmapsResponse& response);
void ToProto(std::span<const Relation> relations, const MapInfo& map, Pager& pager,
             v1::QueryRelationsResponse& response);

/// Maximum memory of answering.
std::size_t BytesOfAnswers(const v1::SearchSubmapsRequest& request);
std::size_t BytesOfAnswers(const v1::QueryRelationsRequest& request);

}  // namespace dhpmap
