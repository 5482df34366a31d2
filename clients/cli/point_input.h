// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// Reads coordinates from text: three numbers per point, separated by blanks, commas or line breaks; '#' starts a
/// comment. INVALID_ARGUMENT, with the line, for other text, no points, or an incomplete point.
Result<std::vector<float>> ReadPoints(std::istream& in);

}  // namespace dhpmap
