// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "mapping/labels/label_set.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Of what somebody names a map or a submap.
inline constexpr std::size_t kMaxDisplayNameBytes = 256;

/// What a person may call the submap: the name that somebody gave it, else one after its present class, with its id if
/// it is a thing: "sofa 7". A given name that has just that form, of any class, follows the class too: older maps hold
/// such names of their own making.
std::string DisplayNameOf(const SubmapInfo& info, const LabelSet& labels);

}  // namespace dhpmap
