// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// Whether a class is countable (one submap an object) or background (one submap a class).
enum class Panoptic : std::uint8_t { kUnknown = 0, kThing = 1, kStuff = 2 };

}  // namespace dhpmap
