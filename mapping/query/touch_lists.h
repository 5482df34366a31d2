// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/ids.h"

namespace dhpmap {

/// Which submaps each part of a robot may touch: QueryScope::may_touch of what is asked of it. Parts that may touch the
/// same share a list. Value type.
struct TouchLists {
  std::vector<std::vector<SubmapId>> lists = {{}};  ///< at least one
  std::vector<std::uint32_t> list_of;               ///< by number of the part; empty: all have the first

  [[nodiscard]] std::size_t ListOf(std::size_t part) const { return list_of.empty() ? 0 : list_of[part]; }
};

}  // namespace dhpmap
