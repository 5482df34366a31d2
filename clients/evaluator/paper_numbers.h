// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace dhpmap::evaluator {

/// A row of Hu et al., DHP-Mapping, IROS 2024, Tables I to III, with our names; values missing in a table are empty.
/// Table I as printed violates PQ <= min(SQ, RQ), which holds for every segmentation. With its columns PQ and SQ
/// exchanged every row satisfies it, so they are exchanged here.
struct PaperRow {
  std::string_view preset;  ///< indoor: the paper's "flat" data set; outdoor_lidar: its SemanticKITTI
  std::string_view system;
  std::optional<double> pq, sq, rq, mean_iou, accuracy;
  std::array<std::optional<double>, 3> mean_precision;  ///< at IoU 0.3, 0.4, 0.5
  std::optional<double> accuracy_m, completion_m, chamfer_l1_m, f_score_percent;
};

/// Null if the paper has no such row.
const PaperRow* FindPaperRow(std::string_view preset, std::string_view system);

/// The paper's name of the data set with this preset, or the preset itself.
std::string_view PaperDataset(std::string_view preset);

}  // namespace dhpmap::evaluator
