// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/class_map.h"

#include <algorithm>
#include <sstream>

#include "clients/datasets/file_reader.h"

namespace dhpmap::evaluator {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxClasses = 30000;
constexpr const char* kFileName = "evaluation_classes.csv";

Status Insert(const std::vector<std::uint32_t>& ids, std::int16_t place, const char* whose,
              std::map<std::uint32_t, std::int16_t>& index) {
  for (const std::uint32_t id : ids) {
    if (index.emplace(id, place).second) continue;
    return InvalidArgument(std::string(whose) + " id " + std::to_string(id) + " stands for two evaluated classes");
  }
  return Status::Ok();
}

Result<std::uint32_t> ParseId(const std::string& cell) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t id, ParseInteger(cell));
  if (id < 0 || id > 65534) return InvalidArgument("class id " + cell + " is not 0 to 65534");
  return static_cast<std::uint32_t>(id);
}

Result<EvaluatedClass> ParseRow(const TextRow& row) {
  if (row.cells.size() < 3) return InvalidArgument("needs ClassID,Name,Thing,SemanticKITTI");
  EvaluatedClass out;
  DHPMAP_ASSIGN_OR_RETURN(const std::uint32_t id, ParseId(row.cells[0]));
  out.predicted_ids = {id};
  out.name = row.cells[1];
  if (row.cells[2] != "0" && row.cells[2] != "1") return InvalidArgument("Thing is '" + row.cells[2] + "', not 0 or 1");
  out.is_thing = row.cells[2] == "1";
  std::istringstream words(row.cells.size() > 3 ? row.cells[3] : "");
  for (std::string word; words >> word;) {
    DHPMAP_ASSIGN_OR_RETURN(const std::uint32_t truth_id, ParseId(word));
    out.truth_ids.push_back(truth_id);
  }
  return out;
}

bool IsThere(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

/// Empty if no file exists.
fs::path FindFile(const fs::path& directory) {
  std::error_code ignored;
  fs::path folder = fs::weakly_canonical(directory, ignored);
  if (IsThere(folder / kFileName)) return folder / kFileName;
  for (const fs::path& parent : {folder, folder / "sequences"}) {
    for (const fs::path& sequence : FoldersWithPrefix(parent, "")) {
      if (IsThere(sequence / kFileName)) return sequence / kFileName;
    }
  }
  for (int level = 0; level < 2; ++level) {  // sequences/, the root
    folder = folder.parent_path();
    if (IsThere(folder / kFileName)) return folder / kFileName;
  }
  return {};
}

std::size_t NumShared(const std::vector<LabelClass>& truth, const std::vector<LabelClass>& predicted, bool by_name) {
  return static_cast<std::size_t>(std::count_if(truth.begin(), truth.end(), [&](const LabelClass& wanted) {
    return std::any_of(predicted.begin(), predicted.end(), [&](const LabelClass& there) {
      return there.id == wanted.id && (!by_name || there.name == wanted.name);
    });
  }));
}

}  // namespace

Result<ClassMap> ClassMap::Create(std::vector<EvaluatedClass> classes) {
  if (classes.empty()) return InvalidArgument("there is no class to evaluate");
  if (classes.size() > kMaxClasses) return InvalidArgument("there are more than 30000 classes to evaluate");
  ClassMap map;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto place = static_cast<std::int16_t>(i);
    DHPMAP_RETURN_IF_ERROR(Insert(classes[i].truth_ids, place, "ground truth", map.of_truth_));
    DHPMAP_RETURN_IF_ERROR(Insert(classes[i].predicted_ids, place, "predicted", map.of_prediction_));
  }
  map.classes_ = std::move(classes);
  return map;
}

Result<ClassMap> ClassMap::Same(const std::vector<LabelClass>& truth) {
  std::vector<EvaluatedClass> classes;
  for (const LabelClass& c : truth) {
    classes.push_back({c.name, c.panoptic == Panoptic::kThing, {c.id.value}, {c.id.value}});
  }
  return Create(std::move(classes));
}

Result<ClassMap> ClassMap::Read(const fs::path& file) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(file, ','));
  std::vector<EvaluatedClass> classes;
  for (const TextRow& row : rows) {
    if (row.cells[0] == "ClassID") continue;
    Result<EvaluatedClass> parsed = ParseRow(row);
    if (!parsed.ok()) return BadFile(file, "line " + std::to_string(row.line) + ": " + parsed.status().message());
    if (!parsed->truth_ids.empty()) classes.push_back(std::move(parsed).value());
  }
  Result<ClassMap> map = Create(std::move(classes));
  return map.ok() ? std::move(map) : BadFile(file, map.status().message());
}

Result<ClassMap> FindClassMap(const fs::path& directory, const std::vector<LabelClass>& truth,
                              const std::vector<LabelClass>& predicted) {
  if (NumShared(truth, predicted, true) == truth.size()) return ClassMap::Same(truth);
  const fs::path file = FindFile(directory);
  if (!file.empty()) return ClassMap::Read(file);
  if (2 * NumShared(truth, predicted, false) > truth.size()) return ClassMap::Same(truth);
  return FailedPrecondition("classes of ground truth and prediction differ, and there is no " + std::string(kFileName) +
                            " at " + directory.string())
      .WithReason("NO_CLASS_MAP");
}

}  // namespace dhpmap::evaluator
