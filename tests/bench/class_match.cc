// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/class_match.h"

#include <algorithm>
#include <sstream>

#include "clients/datasets/file_reader.h"

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
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(file, ','));
  for (const TextRow& row : rows) {
    if (row.cells[0] == "ClassID" || row.cells.size() < 4) continue;
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t id, ParseInteger(row.cells[0]));
    std::istringstream truth_ids(row.cells[3]);
    for (std::uint32_t truth_id = 0; truth_ids >> truth_id;) match[truth_id].insert(static_cast<std::uint32_t>(id));
  }
  return match;
}

}  // namespace dhpmap
