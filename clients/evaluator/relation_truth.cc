// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/relation_truth.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

namespace dhpmap::evaluator {
namespace {

std::optional<RelationKind> KindNamed(const std::string& name) {
  for (const RelationKind kind : {RelationKind::kOn, RelationKind::kIn, RelationKind::kNextTo}) {
    if (name == NameOf(kind)) return kind;
  }
  return std::nullopt;
}

void AddEntry(const nlohmann::json& entry, RelationTruth& truth) {
  const auto subject = entry.at("id").get<std::uint32_t>();
  truth.names[subject] = entry.at("name").get<std::string>();
  for (const nlohmann::json& relation : entry.at("relations")) {
    const auto kind = KindNamed(relation.at("kind").get<std::string>());
    if (kind) truth.relations.insert(MakeNamedRelation(*kind, subject, relation.at("object").get<std::uint32_t>()));
  }
}

}  // namespace

const char* NameOf(RelationKind kind) {
  switch (kind) {
    case RelationKind::kOn: return "ON";
    case RelationKind::kIn: return "IN";
    case RelationKind::kNextTo: return "NEXT_TO";
  }
  return "";
}

NamedRelation MakeNamedRelation(RelationKind kind, std::uint32_t subject, std::uint32_t object) {
  if (kind == RelationKind::kNextTo && object < subject) std::swap(subject, object);
  return {kind, subject, object};
}

Result<RelationTruth> ReadRelationTruth(const std::string& path) {
  std::ifstream in(path);
  if (!in) return NotFound("cannot read " + path + ": dhpmap-simulate writes it");
  RelationTruth truth;
  try {
    for (const nlohmann::json& entry : nlohmann::json::parse(in)) AddEntry(entry, truth);
  } catch (const nlohmann::json::exception& error) {
    return InvalidArgument(path + " tells no relations: " + error.what());
  }
  if (truth.relations.empty()) return InvalidArgument(path + " tells no relations");
  return truth;
}

}  // namespace dhpmap::evaluator
