// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "mapping/labels/label_set.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Limit of names that users give to maps and submaps.
inline constexpr std::size_t kMaxDisplayNameBytes = 256;

/// The submap's name for people: the given name, else its class, with the id for a thing: "sofa 7". A given name of
/// exactly that form, of any class, follows the class too, because older maps stored generated names.
std::string DisplayNameOf(const SubmapInfo& info, const LabelSet& labels);

}  // namespace dhpmap
