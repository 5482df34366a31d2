// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"
#include "mapping/labels/label_set.h"

namespace dhpmap {

inline constexpr std::size_t kMaxClassNameBytes = 128;
/// Limit of all class names of a label set, which are sent with the map in one message.
inline constexpr std::size_t kMaxClassNamesBytes = 1 << 20;

/// Checks the names of a new map's label set; older maps may have others. INVALID_ARGUMENT, with violations of
/// "classes[id]", for a name that is too long or used twice (case-sensitive; an empty name is no name), or for too many
/// bytes in total.
Status ValidateClassNames(const std::vector<LabelClass>& classes);

/// The class of a name: an exact match, else the first, by id, ignoring ASCII case and surrounding blanks. Null if
/// there is none, or for a blank name.
const LabelClass* FindClassByName(const LabelSet& label_set, std::string_view name);

/// "there is no class 'sofaa'; did you mean 'sofa'?", for a name that FindClassByName does not find. After `told` such
/// messages, only the first half: suggestions take time, and a request may name a million.
std::string NoSuchClassText(const LabelSet& label_set, std::string_view name, const Status& told = Status::Ok());

}  // namespace dhpmap
