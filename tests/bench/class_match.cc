// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/class_match.h"

#include <algorithm>

#include "clients/evaluator/class_map.h"

namespace dhpmap {
namespace {

bool HasClassesOf(const v1::Map& map, const std::vector<LabelClass>& truth) {
  return std::all_of(truth.begin(), truth.end(), [&map](const LabelClass& wanted) {
    return std::any_of(map.label_classes().begin(), map.label_classes().end(), [&wanted](const v1::LabelClass& there) {
      return there.id() == wanted.id.value && there.name() == wanted.name;
    });
  });
}

}  // namespace

Result<ClassMatch> MatchClasses(const v1::Map& map, const std::vector<LabelClass>& truth,
                                const std::filesystem::path& file) {
  ClassMatch match;
  std::error_code ignored;
  if (HasClassesOf(map, truth) || !std::filesystem::exists(file, ignored)) {
    for (const LabelClass& label_class : truth) match[label_class.id.value] = {label_class.id.value};
    return match;
  }
  DHPMAP_ASSIGN_OR_RETURN(const evaluator::ClassMap classes, evaluator::ClassMap::Read(file));
  for (const evaluator::EvaluatedClass& evaluated : classes.classes()) {
    for (const std::uint32_t id : evaluated.truth_ids) {
      match[id].insert(evaluated.predicted_ids.begin(), evaluated.predicted_ids.end());
    }
  }
  return match;
}

}  // namespace dhpmap
