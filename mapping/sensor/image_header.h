// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mapping/base/result.h"

namespace dhpmap {

enum class ImageKind { kPng, kJpeg, kTiff };

struct ImageHeader {
  ImageKind kind = ImageKind::kPng;
  std::int64_t width_px = 0;
  std::int64_t height_px = 0;
  /// Size of the largest buffer for decoding: all pixels with their channels, or a tile of a TIFF if that is larger.
  std::int64_t decoded_bytes = 0;
};

/// Reads kind and size from a compressed image file and checks that the file is complete: PNG up to its IEND chunk,
/// JPEG up to its EOI marker, every strip or tile of a (classic) TIFF inside the file. (Some decoders fill missing
/// parts with grey.) Refuses ambiguous files, such as a JPEG with two frame headers, so that the decoder will find the
/// same size. INVALID_ARGUMENT, reason BAD_IMAGE. Does not decode; pixels may still be corrupt.
Result<ImageHeader> ReadImageHeader(std::span<const std::byte> file);

}  // namespace dhpmap
