// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clients/datasets/dataset.h"

namespace dhpmap {

/// kAnyFormat and the names of the formats: "flat", "kitti", ...
std::vector<std::string> DatasetFormats();

/// `directory` is the root of the data set or one of its recordings; of several, the first by name is opened. `format`
/// is one of DatasetFormats(). NOT_FOUND or INVALID_ARGUMENT name what is missing; FAILED_PRECONDITION, reason
/// NO_LABELS, if the data set has no labels of this kind.
Result<std::unique_ptr<Dataset>> OpenDataset(const std::string& directory, const std::string& format,
                                             LabelSource labels, const DatasetOptions& options = {});

}  // namespace dhpmap
