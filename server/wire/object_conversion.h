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

// Questions about objects, for the page that the pager is to give out. INVALID_ARGUMENT, naming the field, for a name,
// place, number, kind or page token that is not usable, NOT_FOUND for a submap that is not there; errors of
// QueryOptionsFromProto.
Result<SubmapQuestion> SubmapQuestionFromProto(const v1::SearchSubmapsRequest& request, const MapSnapshot& map,
                                               const Pager& pager);
Result<RelationQuestion> RelationQuestionFromProto(const v1::QueryRelationsRequest& request, const MapSnapshot& map,
                                                   const Pager& pager);

// The page, of the answers to such a question.
void ToProto(const SubmapQuestion& question, std::span<const SubmapMatch> matches, const MapView& view, Pager& pager,
             v1::SearchSubmapsResponse& response);
void ToProto(std::span<const Relation> relations, const MapInfo& map, Pager& pager,
             v1::QueryRelationsResponse& response);

/// What answering takes of memory at most.
std::size_t BytesOfAnswers(const v1::SearchSubmapsRequest& request);
std::size_t BytesOfAnswers(const v1::QueryRelationsRequest& request);

}  // namespace dhpmap
