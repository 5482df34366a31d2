// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/base/result.h"
#include "mapping/images/decoded_image.h"

namespace dhpmap {

/// Decodes the first image of a TIFF: grey or colour of 8, 16, 32 or 64 bits a sample, in strips or tiles, uncompressed
/// or with lossless compression (LZW, deflate, PackBits). Ignores its orientation. Memory: the pixels and a tile, so
/// check its size first (ReadImageHeader). INVALID_ARGUMENT, reason BAD_IMAGE, for anything corrupt or of another kind.
Result<DecodedImage> DecodeTiff(std::span<const std::byte> file);

}  // namespace dhpmap
