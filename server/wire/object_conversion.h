// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "dhpmap/v1/search.pb.h"
#include "mapping/query/relations.h"
#include "mapping/query/submap_search.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

// Questions about objects. INVALID_ARGUMENT, naming the field, for a name, place, number or kind that is not usable,
// NOT_FOUND for a submap that is not there; errors of QueryOptionsFromProto.
Result<SubmapQuestion> SubmapQuestionFromProto(const v1::SearchSubmapsRequest& request, const MapSnapshot& map);
Result<RelationQuestion> RelationQuestionFromProto(const v1::ListRelationsRequest& request, const MapSnapshot& map);

void ToProto(const SubmapQuestion& question, std::span<const SubmapMatch> matches, const MapView& view,
             v1::SearchSubmapsResponse& response);
void ToProto(std::span<const Relation> relations, const MapInfo& map, v1::ListRelationsResponse& response);

/// What answering takes of memory at most.
std::size_t BytesOfAnswers(const v1::SearchSubmapsRequest& request);
std::size_t BytesOfAnswers(const v1::ListRelationsRequest& request);

}  // namespace dhpmap
