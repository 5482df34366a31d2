// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::evaluator {

/// Parses "key=value"; INVALID_ARGUMENT for one without '=' or without a key.
Result<std::vector<std::pair<std::string, std::string>>> ParseSettings(const std::vector<std::string>& settings);

/// A name for a data set's directory: "house", or "kitti 07" for .../kitti/sequences/07.
std::string DatasetName(const std::string& directory);

/// Replaces the file. UNAVAILABLE if it cannot be written.
Status WriteText(const std::string& path, const std::string& text);

/// UNAVAILABLE for the first file whose folder does not exist, so that a long run does not fail at its end. Skips empty
/// paths.
Status CheckWritable(const std::vector<std::string>& paths);

}  // namespace dhpmap::evaluator
