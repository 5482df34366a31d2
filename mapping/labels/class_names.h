// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "mapping/base/status.h"
#include "mapping/labels/label_set.h"

namespace dhpmap {

inline constexpr std::size_t kMaxClassNameBytes = 128;
/// Of all of a label set's names: whoever asks for a map gets them in one message.
inline constexpr std::size_t kMaxClassNamesBytes = 1 << 20;

/// What is asked of the names in a new map's label set; older maps may hold others. INVALID_ARGUMENT, with violations
/// of "classes[id]", for a name that is too long, that two classes have (in the same case; none is no name), or for too
/// many bytes together.
Status ValidateClassNames(const std::vector<LabelClass>& classes);

}  // namespace dhpmap
