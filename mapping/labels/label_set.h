// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"
#include "mapping/labels/color.h"
#include "mapping/labels/panoptic.h"

namespace dhpmap {

/// Typical extent of a class's objects; selects the minimum number of points of a new submap.
enum class SizeClass : std::uint8_t { kSmall = 0, kMedium = 1, kLarge = 2 };

struct LabelClass {
  ClassId id;
  std::string name;
  Panoptic panoptic = Panoptic::kThing;
  SizeClass size = SizeClass::kMedium;
  Color color;
  bool operator==(const LabelClass&) const = default;
};

/// The classes of a map. Immutable.
class LabelSet {
 public:
  LabelSet() = default;
  /// INVALID_ARGUMENT, with every violation named, for an id given twice, an id of 65,535, or kUnknown as panoptic
  /// kind.
  static Result<LabelSet> Create(std::vector<LabelClass> classes);

  /// By ascending id.
  [[nodiscard]] const std::vector<LabelClass>& classes() const { return classes_; }
  /// Null if the class is not in the set.
  [[nodiscard]] const LabelClass* Find(ClassId id) const;
  [[nodiscard]] bool empty() const { return classes_.empty(); }
  bool operator==(const LabelSet&) const = default;

 private:
  std::vector<LabelClass> classes_;
};

}  // namespace dhpmap
