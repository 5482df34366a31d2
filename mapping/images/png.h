// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "mapping/base/result.h"
#include "mapping/images/decoded_image.h"

namespace dhpmap {

/// Decodes a PNG of up to 16 bits a sample; fewer than 8 bits are expanded, palettes become colour. Ignores gamma and
/// colour profiles. Memory: the pixels and some MiB, so check its size first (ReadImageHeader). INVALID_ARGUMENT,
/// reason BAD_IMAGE, for anything corrupt, including checksums.
Result<DecodedImage> DecodePng(std::span<const std::byte> file);

/// 8-bit grey, width x height, row by row.
Result<std::string> EncodePng(std::span<const std::uint8_t> pixels, int width_px, int height_px);

}  // namespace dhpmap
