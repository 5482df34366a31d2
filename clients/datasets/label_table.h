// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/labels/label_set.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// One row of a label CSV (`InstanceID,ClassID,PanopticID,R,G,B,Name,Size`, in any order; other columns are ignored).
struct LabelRow {
  std::int64_t instance_id = 0;  ///< pixel value (ground truth) or category id (predictions)
  LabelClass label_class;        ///< its name is that of the row
  bool is_unknown = false;       ///< named "unknown", or the remaining "things" of panoptic COCO models
};

/// Whether names are of classes ("chair"), or of instances ("ChairA_01_003"), several of which share a ClassID.
enum class RowNames { kClasses, kInstances };

/// The meaning of ids. Immutable.
class LabelTable {
 public:
  /// ClassID, R, G, B and Size are optional: by default the class is the InstanceID, the colour is from a palette, the
  /// size medium. Skips rows without InstanceID.
  static Result<LabelTable> Read(const std::filesystem::path& path, RowNames names);

  /// By class id, without unknown ones; a class has the most frequent kind and size of its rows.
  [[nodiscard]] const std::vector<LabelClass>& classes() const { return classes_; }
  /// Null if no row has this id.
  [[nodiscard]] const LabelRow* Find(std::int64_t instance_id) const;
  /// One segment for each row: the ground-truth meaning of ids in every frame.
  [[nodiscard]] std::vector<SegmentInfo> AllSegments() const;

 private:
  std::vector<LabelRow> rows_;
  std::unordered_map<std::int64_t, std::size_t> row_of_;
  std::vector<LabelClass> classes_;
};

/// "ChairA_01_003" -> "Chair": drops trailing _NN groups, then one capital, which identifies a model.
std::string ClassNameOfInstance(const std::string& instance_name);

/// The common part of the instance names of a class: {"Door", "FoldingDoor"} -> "Door"; the first name if there is
/// none.
std::string CommonName(const std::vector<std::string>& names);

/// A colour for an id, distinct from those of neighbouring ids.
Color PaletteColor(std::uint32_t id);

}  // namespace dhpmap
