// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/ids.h"

namespace dhpmap {

/// Allowed contacts of each part of a robot (QueryScope::may_touch). Parts with the same contacts share a list. Value
/// type.
struct TouchLists {
  std::vector<std::vector<SubmapId>> lists = {{}};  ///< at least one
  std::vector<std::uint32_t> list_of;               ///< by number of the part; empty: the first list for all

  [[nodiscard]] std::size_t ListOf(std::size_t part) const { return list_of.empty() ? 0 : list_of[part]; }
};

}  // namespace dhpmap
