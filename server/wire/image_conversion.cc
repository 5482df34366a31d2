// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/image_conversion.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "mapping/sensor/image_header.h"

namespace dhpmap {
namespace {

static_assert(std::endian::native == std::endian::little, "raw images are little-endian and copied as they are");

Status BadImage(std::string_view field, const std::string& what) {
  return InvalidArgument(std::string(field) + " " + what)
      .WithReason("BAD_IMAGE")
      .WithViolation(std::string(field), what);
}

Status WrongEncoding(const v1::Image& image, std::string_view field, const char* allowed) {
  const std::string name = v1::Image::Encoding_Name(image.encoding());
  return BadImage(field, "cannot be " + (name.empty() ? std::to_string(image.encoding()) : name) + ", only " + allowed);
}

std::span<const std::byte> Bytes(const v1::Image& image) { return std::as_bytes(std::span(image.data())); }

template <typename Pixel>
Result<std::vector<Pixel>> RawPixels(const v1::Image& image, int width_px, int height_px, std::string_view field) {
  static_assert(std::is_trivially_copyable_v<Pixel>);
  const std::size_t num_pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  const std::size_t wanted_bytes = num_pixels * sizeof(Pixel);
  if (image.data().size() != wanted_bytes) {
    return BadImage(field, "has " + std::to_string(image.data().size()) + " bytes, but " + std::to_string(width_px) +
                               " x " + std::to_string(height_px) + " pixels of " +
                               v1::Image::Encoding_Name(image.encoding()) + " are " + std::to_string(wanted_bytes));
  }
  std::vector<Pixel> pixels(num_pixels);
  std::memcpy(static_cast<void*>(pixels.data()), image.data().data(), wanted_bytes);
  return pixels;
}

/// Converts raw pixels of one type to another.
template <typename Raw, typename Pixel>
Result<Image<Pixel>> RawImage(const v1::Image& image, int width_px, int height_px, std::string_view field) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<Raw> raw, RawPixels<Raw>(image, width_px, height_px, field));
  Image<Pixel> result{.width_px = width_px, .height_px = height_px};
  if constexpr (std::is_same_v<Raw, Pixel>) result.pixels = std::move(raw);
  else result.pixels.assign(raw.begin(), raw.end());
  return result;
}

/// Decodes a file of the expected size. Reads the header first, because decoding allocates what the header says.
template <typename Decode>
auto DecodeFile(const v1::Image& image, int width_px, int height_px, std::string_view field, Decode decode)
    -> decltype(decode(Bytes(image))) {
  const Result<ImageHeader> header = ReadImageHeader(Bytes(image));
  if (!header.ok()) return BadImage(field, "cannot be decoded: " + header.status().message());
  if (header->width_px != width_px || header->height_px != height_px) {
    return BadImage(field, "is " + std::to_string(header->width_px) + " x " + std::to_string(header->height_px) +
                               " pixels, the camera " + std::to_string(width_px) + " x " + std::to_string(height_px));
  }
  auto decoded = decode(Bytes(image));
  if (!decoded.ok()) return BadImage(field, "cannot be decoded: " + decoded.status().message());
  return decoded;
}

Result<std::vector<float>> ScaledDepth(const v1::Image& image, int width_px, int height_px, std::string_view field) {
  constexpr std::uint16_t kNoReturn = 65535;
  if (!(image.scale_m() > 0) || !std::isfinite(image.scale_m())) {
    return BadImage(field, "is of integers, so scale_m must be set to the metres of a unit");
  }
  DHPMAP_ASSIGN_OR_RETURN(const auto raw, RawPixels<std::uint16_t>(image, width_px, height_px, field));
  std::vector<float> depth_m(raw.size());
  const auto scale_m = static_cast<float>(image.scale_m());
  for (std::size_t i = 0; i < raw.size(); ++i) depth_m[i] = raw[i] == kNoReturn ? 0.0f : raw[i] * scale_m;
  return depth_m;
}

}  // namespace

Result<std::vector<float>> DepthFromProto(const v1::Image& image, int width_px, int height_px, std::string_view field) {
  switch (image.encoding()) {
    case v1::Image::RAW_F32: return RawPixels<float>(image, width_px, height_px, field);
    case v1::Image::RAW_U16: return ScaledDepth(image, width_px, height_px, field);
    case v1::Image::FILE: break;
    default: return WrongEncoding(image, field, "FILE, RAW_F32 or RAW_U16");
  }
  const auto decode = [&image](std::span<const std::byte> file) { return DecodeDepth(file, image.scale_m()); };
  DHPMAP_ASSIGN_OR_RETURN(auto decoded, DecodeFile(image, width_px, height_px, field, decode));
  return std::move(decoded.pixels);
}

Result<Image<Color>> ColorFromProto(const v1::Image& image, int width_px, int height_px, std::string_view field) {
  static_assert(sizeof(Color) == 3);
  switch (image.encoding()) {
    case v1::Image::RAW_RGB8: return RawImage<Color, Color>(image, width_px, height_px, field);
    case v1::Image::FILE: return DecodeFile(image, width_px, height_px, field, DecodeColor);
    default: return WrongEncoding(image, field, "FILE or RAW_RGB8");
  }
}

Result<Image<std::uint32_t>> SegmentsFromProto(const v1::Image& image, int width_px, int height_px,
                                               std::string_view field) {
  switch (image.encoding()) {
    case v1::Image::RAW_U8: return RawImage<std::uint8_t, std::uint32_t>(image, width_px, height_px, field);
    case v1::Image::RAW_U16: return RawImage<std::uint16_t, std::uint32_t>(image, width_px, height_px, field);
    case v1::Image::RAW_U32: return RawImage<std::uint32_t, std::uint32_t>(image, width_px, height_px, field);
    case v1::Image::FILE: return DecodeFile(image, width_px, height_px, field, DecodeSegments);
    default: return WrongEncoding(image, field, "FILE, RAW_U8, RAW_U16 or RAW_U32");
  }
}

}  // namespace dhpmap
