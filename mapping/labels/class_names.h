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
/// Of all of a label set's names: whoever asks for a map gets them in one message.
inline constexpr std::size_t kMaxClassNamesBytes = 1 << 20;

/// What is asked of the names in a new map's label set; older maps may hold others. INVALID_ARGUMENT, with violations
/// of "classes[id]", for a name that is too long, that two classes have (in the same case; none is no name), or for too
/// many bytes together.
Status ValidateClassNames(const std::vector<LabelClass>& classes);

/// The class that somebody means by a name: the one of exactly this name, else the first, by id, where ASCII case and
/// blanks around do not count. Null if there is none; a name of blanks means none.
const LabelClass* FindClassByName(const LabelSet& label_set, std::string_view name);

/// "there is no class 'sofaa'; did you mean 'sofa'?", for a name that FindClassByName does not find. Where as much as
/// `told` has been said already, only the first half: what is near takes time, and a request may name a million.
std::string NoSuchClassText(const LabelSet& label_set, std::string_view name, const Status& told = Status::Ok());

}  // namespace dhpmap
