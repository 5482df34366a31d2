// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/labels/color.h"

namespace dhpmap {

/// Row-major pixels.
template <typename Pixel>
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<Pixel> pixels;
};

// Decoders of a compressed image file in memory (PNG, JPEG, TIFF). INVALID_ARGUMENT, reason BAD_IMAGE, for a file that
// is truncated, of another kind or pixel type, above 16384 pixels a side or 2^26 in all, or needs more than 2^28 bytes
// to decode.

/// 32-bit float images are metres. 16-bit integer images are multiplied by `scale_m` (metres a unit), which must then
/// be positive; their 0 and 65535 mean no return. Every other type is refused.
Result<Image<float>> DecodeDepth(std::span<const std::byte> file, double scale_m);

/// 8-bit grey or colour.
Result<Image<Color>> DecodeColor(std::span<const std::byte> file);

/// 8- or 16-bit grey, or the blue channel of a colour image, as in the flat data set. JPEG is refused, because it is
/// lossy.
Result<Image<std::uint32_t>> DecodeSegments(std::span<const std::byte> file);

}  // namespace dhpmap
