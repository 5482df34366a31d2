// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// std::floor for values within int32, without a call and in a form that vectorises on machines without SSE4.1.
__attribute__((always_inline)) inline std::int32_t FloorToInt(float value) {
  const auto truncated = static_cast<std::int32_t>(value);
  return truncated - static_cast<std::int32_t>(value < static_cast<float>(truncated));
}

}  // namespace dhpmap
