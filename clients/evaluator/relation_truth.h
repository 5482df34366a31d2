// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "mapping/base/result.h"
#include "mapping/query/relations.h"

namespace dhpmap::evaluator {

/// Kind, subject and object, by ids of the truth. Of kNextTo the lesser id comes first.
using NamedRelation = std::tuple<RelationKind, std::uint32_t, std::uint32_t>;

/// What dhpmap-simulate tells in truth.json of what is on, in or next to what.
struct RelationTruth {
  std::map<std::uint32_t, std::string> names;  ///< of all that was seen
  std::set<NamedRelation> relations;           ///< HANGS_ON is left out: maps tell no such relation
};

/// NOT_FOUND without the file, INVALID_ARGUMENT for one that is damaged or tells no relations.
Result<RelationTruth> ReadRelationTruth(const std::string& path);

NamedRelation MakeNamedRelation(RelationKind kind, std::uint32_t subject, std::uint32_t object);
/// As in files: ON, IN, NEXT_TO.
const char* NameOf(RelationKind kind);

}  // namespace dhpmap::evaluator
