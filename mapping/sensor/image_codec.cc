// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/image_codec.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mapping/images/jpeg.h"
#include "mapping/images/png.h"
#include "mapping/images/tiff.h"
#include "mapping/sensor/image_header.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kMaxSide_px = 16384;
// A small file can claim, and hold, any size.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;
constexpr std::int64_t kMaxDecodedBytes = std::int64_t{1} << 28;  // as many pixels of float or of 8-bit colour
constexpr std::uint16_t kNoReturn = 0xFFFF;

Status BadImage(std::string what) { return InvalidArgument(std::move(what)).WithReason("BAD_IMAGE"); }

std::string TypeName(const DecodedImage& image) {
  return ToString(image.type) + " x " + std::to_string(image.num_channels);
}

Result<DecodedImage> DecodeKind(ImageKind kind, std::span<const std::byte> file) {
  switch (kind) {
    case ImageKind::kPng: return DecodePng(file);
    case ImageKind::kJpeg: return DecodeJpeg(file);
    case ImageKind::kTiff: return DecodeTiff(file);
  }
  return BadImage("the image is of no kind");
}

/// Where blue stands; of grey, its only channel.
std::size_t BlueOf(const DecodedImage& image) { return image.num_channels < 3 ? 0 : 2; }

/// The pixels as stored: no change of depth, channels or orientation.
Result<DecodedImage> Decode(std::span<const std::byte> file) {
  DHPMAP_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(file));
  const std::string size = std::to_string(header.width_px) + " x " + std::to_string(header.height_px) + " pixels";
  if (header.width_px < 1 || header.height_px < 1 || header.width_px > kMaxSide_px || header.height_px > kMaxSide_px ||
      header.width_px * header.height_px > kMaxPixels) {
    return BadImage("the image has " + size + ", which is not 1 to 16384 a side and 2^26 in all");
  }
  if (header.decoded_bytes > kMaxDecodedBytes) {
    return BadImage("the image of " + size + " takes more than 2^28 bytes when decoded");
  }
  DHPMAP_ASSIGN_OR_RETURN(DecodedImage image, DecodeKind(header.kind, file));
  if (image.width_px != header.width_px || image.height_px != header.height_px) {
    return BadImage("the image is not of " + size);
  }
  return image;
}

/// Calls convert(row pointer of type Value, channels, first output pixel, number of pixels) for each row.
template <typename Value, typename Pixel, typename ConvertRow>
Image<Pixel> Convert(const DecodedImage& image, const ConvertRow& convert) {
  Image<Pixel> out{.width_px = image.width_px, .height_px = image.height_px, .pixels = {}};
  const auto width = static_cast<std::size_t>(image.width_px);
  out.pixels.resize(width * static_cast<std::size_t>(image.height_px));
  for (int v = 0; v < image.height_px; ++v) {
    convert(image.Row<Value>(v), &out.pixels[static_cast<std::size_t>(v) * width], image.width_px);
  }
  return out;
}

template <typename Value>
Image<std::uint32_t> GreyOrBlue(const DecodedImage& image) {
  const int channels = image.num_channels;
  return Convert<Value, std::uint32_t>(image, [&image, channels](const Value* in, std::uint32_t* out, int count) {
    in += BlueOf(image);
    for (int i = 0; i < count; ++i) out[i] = in[std::ptrdiff_t{i} * channels];
  });
}

}  // namespace

Result<Image<float>> DecodeDepth(std::span<const std::byte> file, double scale_m) {
  DHPMAP_ASSIGN_OR_RETURN(const DecodedImage image, Decode(file));
  if (image.type == SampleType::kFloat && image.num_channels == 1) {
    return Convert<float, float>(image, [](const float* in, float* out, int count) { std::copy_n(in, count, out); });
  }
  if (image.type != SampleType::kUint16 || image.num_channels != 1) {
    return BadImage("depth must be float or uint16 with 1 channel, not " + TypeName(image));
  }
  if (!(scale_m > 0) || !std::isfinite(scale_m)) {
    return BadImage("depth is uint16, but its scale is " + std::to_string(scale_m) + " m, not positive");
  }
  return Convert<std::uint16_t, float>(image, [scale_m](const std::uint16_t* in, float* out, int count) {
    for (int i = 0; i < count; ++i) out[i] = in[i] == kNoReturn ? 0.0f : static_cast<float>(in[i] * scale_m);
  });
}

Result<Image<Color>> DecodeColor(std::span<const std::byte> file) {
  DHPMAP_ASSIGN_OR_RETURN(const DecodedImage image, Decode(file));
  const int channels = image.num_channels;
  if (image.type != SampleType::kUint8 || channels == 2 || channels > 4) {
    return BadImage("colour must be 8-bit grey or colour, not " + TypeName(image));
  }
  if (channels == 1) {
    return Convert<std::uint8_t, Color>(image, [](const std::uint8_t* in, Color* out, int count) {
      for (int i = 0; i < count; ++i) out[i] = {in[i], in[i], in[i]};
    });
  }
  return Convert<std::uint8_t, Color>(image, [channels](const std::uint8_t* in, Color* out, int count) {
    for (int i = 0; i < count; ++i, in += channels) out[i] = {in[0], in[1], in[2]};
  });
}

Result<Image<std::uint32_t>> DecodeSegments(std::span<const std::byte> file) {
  DHPMAP_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(file));
  if (header.kind == ImageKind::kJpeg) return BadImage("segment ids cannot come from JPEG, which does not keep them");
  DHPMAP_ASSIGN_OR_RETURN(const DecodedImage image, Decode(file));
  if (image.type == SampleType::kUint8) return GreyOrBlue<std::uint8_t>(image);
  if (image.type == SampleType::kUint16) return GreyOrBlue<std::uint16_t>(image);
  return BadImage("segment ids must be 8- or 16-bit grey or colour, not " + TypeName(image));
}

}  // namespace dhpmap
