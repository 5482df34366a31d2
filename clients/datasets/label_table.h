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

/// One row of a label CSV (`InstanceID,ClassID,PanopticID,R,G,B,Name,Size`, any order, more columns ignored).
struct LabelRow {
  std::int64_t instance_id = 0;  ///< pixel value (ground truth) or category id (predictions)
  LabelClass label_class;        ///< the name is the row's own
  bool is_unknown = false;       ///< named "unknown", or the "things" that panoptic COCO models leave over
};

/// Whether the names are of classes ("chair"), or of instances ("ChairA_01_003") of which several share a ClassID.
enum class RowNames { kClasses, kInstances };

/// What ids mean. Immutable.
class LabelTable {
 public:
  /// ClassID, R, G, B and Size may be missing: the class is then the InstanceID, the colour made up and the size
  /// medium. Rows without InstanceID are skipped.
  static Result<LabelTable> Read(const std::filesystem::path& path, RowNames names);

  /// By class id, without the unknown ones; a class has the kind and size of most of its rows.
  [[nodiscard]] const std::vector<LabelClass>& classes() const { return classes_; }
  /// Null if there is no such row.
  [[nodiscard]] const LabelRow* Find(std::int64_t instance_id) const;
  /// A segment a row: what ground truth says of its ids in every frame.
  [[nodiscard]] std::vector<SegmentInfo> AllSegments() const;

 private:
  std::vector<LabelRow> rows_;
  std::unordered_map<std::int64_t, std::size_t> row_of_;
  std::vector<LabelClass> classes_;
};

/// "ChairA_01_003" -> "Chair": drops trailing _NN groups, then one capital that tells models apart.
std::string ClassNameOfInstance(const std::string& instance_name);

/// What the names of a class's instances have in common: {"Door", "FoldingDoor"} -> "Door"; the first if that is
/// nothing.
std::string CommonName(const std::vector<std::string>& names);

/// A colour for an id, well apart from those of its neighbours.
Color PaletteColor(std::uint32_t id);

}  // namespace dhpmap
