// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "clients/datasets/label_table.h"

namespace dhpmap {

/// Reads a frame's NNNNNN_labels.json: [{"id", "category_id", "score"?, "class_scores"?: {"category_id": score, ...}},
/// ...]. The category is looked up in `table`; an unknown one gives a segment without class and score. Rows with id 0
/// are left out. Errors have reason MISSING_FILE or BAD_LABELS.
Result<std::vector<SegmentInfo>> ReadSegmentTable(const std::filesystem::path& path, const LabelTable& table);

}  // namespace dhpmap
