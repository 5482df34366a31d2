// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/base/result.h"
#include "mapping/images/decoded_image.h"

namespace dhpmap {

/// The first image of a TIFF: grey or colour of 8, 16, 32 or 64 bits a sample, in strips or tiles, as it is or packed
/// without loss (LZW, deflate, PackBits). Its orientation is not looked at. Takes the pixels and a tile of memory, so
/// its size must have been looked at before (see ReadImageHeader). INVALID_ARGUMENT, reason BAD_IMAGE, for anything
/// corrupt or of another kind.
Result<DecodedImage> DecodeTiff(std::span<const std::byte> file);

}  // namespace dhpmap
