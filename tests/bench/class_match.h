// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/result.h"
#include "mapping/labels/label_set.h"

namespace dhpmap {

/// Which classes of a map are right for a class of the ground truth; ground-truth classes that are not there are not
/// judged.
using ClassMatch = std::map<std::uint32_t, std::set<std::uint32_t>>;

/// From evaluation_classes.csv (`ClassID,Name,Thing,SemanticKITTI`) if `file` is there and the map does not have the
/// classes of the ground truth; else every id stands for itself.
Result<ClassMatch> MatchClasses(const v1::Map& map, const std::vector<LabelClass>& truth,
                                const std::filesystem::path& file);

}  // namespace dhpmap
