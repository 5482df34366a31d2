// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/base/result.h"
#include "mapping/images/decoded_image.h"

namespace dhpmap {

/// Decodes a grey or colour JPEG. Ignores the EXIF orientation, because a camera's calibration refers to the stored
/// pixels. Damage that the format cannot detect gives wrong pixels. Memory: the pixels and a row of blocks, or all
/// coefficients of a progressive file, so check its size first (ReadImageHeader). INVALID_ARGUMENT, reason BAD_IMAGE,
/// for a file that is no JPEG, is truncated, or has more than 500 scans.
Result<DecodedImage> DecodeJpeg(std::span<const std::byte> file);

}  // namespace dhpmap
