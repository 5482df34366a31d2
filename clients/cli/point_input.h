// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// Coordinates from text: three numbers a point, separated by blanks, commas or line breaks; '#' starts a comment.
/// INVALID_ARGUMENT with the line for anything else, and if there are no points or a point is cut off.
Result<std::vector<float>> ReadPoints(std::istream& in);

}  // namespace dhpmap
