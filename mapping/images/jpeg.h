// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/base/result.h"
#include "mapping/images/decoded_image.h"

namespace dhpmap {

/// A JPEG of grey or colour. Its orientation (EXIF) is not looked at: a camera's calibration is that of the pixels as
/// they are stored. Damage that the format cannot tell from pixels gives other pixels. Takes the pixels and a row of
/// blocks of memory; a progressive file all of its coefficients, so its size must have been looked at before (see
/// ReadImageHeader). INVALID_ARGUMENT, reason BAD_IMAGE, for what is no JPEG, is cut off, or has more than 500 scans.
Result<DecodedImage> DecodeJpeg(std::span<const std::byte> file);

}  // namespace dhpmap
