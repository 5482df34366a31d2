// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "clients/datasets/label_table.h"

namespace dhpmap {

/// NNNNNN_labels.json of a frame: [{"id", "category_id", "score"?, "class_scores"?: {"category_id": score, ...}}, ...].
/// The category indexes `table`; unknown ones give a segment without class and have no score, rows with id 0 are left
/// out. Errors have reason MISSING_FILE or BAD_LABELS.
Result<std::vector<SegmentInfo>> ReadSegmentTable(const std::filesystem::path& path, const LabelTable& table);

}  // namespace dhpmap
