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
  /// Of the largest buffer that decoding needs: all pixels with their channels, or a tile of a TIFF if that is larger.
  std::int64_t decoded_bytes = 0;
};

/// Reads kind and size from a compressed image file and checks that the file is whole: PNG up to its IEND chunk, JPEG
/// up to its EOI marker, every strip or tile of a (classic) TIFF inside the file. Some decoders fill up what
/// is missing with grey instead. What it says is what the decoders will go by: a file that says it twice, such as
/// a JPEG with a second frame header, is refused. INVALID_ARGUMENT, reason BAD_IMAGE. Does not decode; the pixels may
/// still be corrupt.
Result<ImageHeader> ReadImageHeader(std::span<const std::byte> file);

}  // namespace dhpmap
