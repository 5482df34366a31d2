// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/labels/label_set.h"

namespace dhpmap {

/// The classes of SemanticKITTI's .label files by their original ids, without "unlabeled" (0) and "outlier" (1).
const std::vector<LabelClass>& SemanticKittiClasses();

/// A word of a .label file: class in the low 16 bits, instance in the high 16 bits.
struct KittiLabel {
  std::uint16_t class_id = 0;
  std::uint16_t instance = 0;
  explicit KittiLabel(std::uint32_t word)
      : class_id(static_cast<std::uint16_t>(word & 0xffff)), instance(static_cast<std::uint16_t>(word >> 16)) {}
  [[nodiscard]] bool is_labelled() const { return class_id > 1; }
  [[nodiscard]] bool is_moving() const { return class_id >= 252; }
};

/// The id of a word's object in all scans: the word itself for things, the class for stuff. 0 (no label) for unlabelled
/// points, unknown classes, and things without an instance.
std::uint32_t PersistentId(std::uint32_t word);

}  // namespace dhpmap
