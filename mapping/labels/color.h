// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// 8-bit sRGB as the camera gave it.
struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  constexpr bool operator==(const Color&) const = default;
};

}  // namespace dhpmap
