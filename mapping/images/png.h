// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "mapping/base/result.h"
#include "mapping/images/decoded_image.h"

namespace dhpmap {

/// A PNG of 8 or 16 bits a sample; less are spread to 8, palettes become colour. What a sample means (gamma, profiles)
/// is not looked at. Takes the pixels and some MiB of memory, so its size must have been looked at before (see
/// ReadImageHeader). INVALID_ARGUMENT, reason BAD_IMAGE, for anything corrupt, checksums included.
Result<DecodedImage> DecodePng(std::span<const std::byte> file);

/// 8-bit grey, width x height, row by row.
Result<std::string> EncodePng(std::span<const std::uint8_t> pixels, int width_px, int height_px);

}  // namespace dhpmap
