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

/// Kind, subject and object, by ids of the truth. For kNextTo the smaller id comes first.
using NamedRelation = std::tuple<RelationKind, std::uint32_t, std::uint32_t>;

/// The relations on, in and next to that dhpmap-simulate writes to truth.json.
struct RelationTruth {
  std::map<std::uint32_t, std::string> names;  ///< of all objects that were seen
  std::set<NamedRelation> relations;           ///< without HANGS_ON, which maps do not report
};

/// NOT_FOUND without the file, INVALID_ARGUMENT if it is damaged or has no relations.
Result<RelationTruth> ReadRelationTruth(const std::string& path);

NamedRelation MakeNamedRelation(RelationKind kind, std::uint32_t subject, std::uint32_t object);
/// As in files: ON, IN, NEXT_TO.
const char* NameOf(RelationKind kind);

}  // namespace dhpmap::evaluator
