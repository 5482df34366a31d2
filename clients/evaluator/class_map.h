// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/labels/label_set.h"

namespace dhpmap::evaluator {

/// An evaluated class, and the ids that stand for it.
struct EvaluatedClass {
  std::string name;
  bool is_thing = false;
  std::vector<std::uint32_t> truth_ids;
  std::vector<std::uint32_t> predicted_ids;
  bool operator==(const EvaluatedClass&) const = default;
};

/// Maps classes of the ground truth and of the prediction to evaluated classes, given by their index in classes().
/// Immutable.
class ClassMap {
 public:
  /// For ids that no evaluated class lists: such ground truth is not judged, such a prediction is wrong.
  static constexpr std::int16_t kNone = -1;

  ClassMap() = default;
  /// INVALID_ARGUMENT for no class, more than 30,000, or an id in two classes.
  static Result<ClassMap> Create(std::vector<EvaluatedClass> classes);
  /// Each class of the ground truth equals the class with the same id in the prediction.
  static Result<ClassMap> Same(const std::vector<LabelClass>& truth);
  /// Reads a file `ClassID,Name,Thing,SemanticKITTI`: the predicted class ClassID is right where the ground truth has
  /// one of the blank-separated ids of the last column. Classes without ids are not judged. Errors name file and line.
  static Result<ClassMap> Read(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<EvaluatedClass>& classes() const { return classes_; }
  [[nodiscard]] std::int16_t OfTruth(std::uint32_t id) const { return Look(of_truth_, id); }
  [[nodiscard]] std::int16_t OfPrediction(std::uint32_t id) const { return Look(of_prediction_, id); }

 private:
  using Index = std::map<std::uint32_t, std::int16_t>;
  static std::int16_t Look(const Index& index, std::uint32_t id) {
    const auto it = index.find(id);
    return it == index.end() ? kNone : it->second;
  }

  std::vector<EvaluatedClass> classes_;
  Index of_truth_, of_prediction_;
};

/// Finds the map of a data set. Ids agree if the prediction has every class of the ground truth with the same id and
/// name. Else reads evaluation_classes.csv in `directory`, a sequence below it or a folder above it. Else ids agree if
/// the prediction has most ids of the ground truth; else FAILED_PRECONDITION.
Result<ClassMap> FindClassMap(const std::filesystem::path& directory, const std::vector<LabelClass>& truth,
                              const std::vector<LabelClass>& predicted);

}  // namespace dhpmap::evaluator
