// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/image_codec.h"

#include <cmath>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "mapping/sensor/image_header.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kMaxSide_px = 16384;
// A small file can claim, and hold, any size.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;
constexpr std::int64_t kMaxDecodedBytes = std::int64_t{1} << 28;  // as many pixels of float or of 8-bit colour
constexpr std::uint16_t kNoReturn = 0xFFFF;

Status BadImage(std::string what) { return InvalidArgument(std::move(what)).WithReason("BAD_IMAGE"); }

std::string TypeName(const cv::Mat& image) {
  constexpr const char* kDepthNames[] = {"uint8", "int8", "uint16", "int16", "int32", "float", "double", "half"};
  return kDepthNames[image.depth()] + std::string(" x ") + std::to_string(image.channels());
}

/// The pixels as stored: no change of depth, channels or orientation.
Result<cv::Mat> Decode(std::span<const std::byte> file) {
  DHPMAP_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(file));
  const std::string size = std::to_string(header.width_px) + " x " + std::to_string(header.height_px) + " pixels";
  if (header.width_px < 1 || header.height_px < 1 || header.width_px > kMaxSide_px || header.height_px > kMaxSide_px ||
      header.width_px * header.height_px > kMaxPixels) {
    return BadImage("the image has " + size + ", which is not 1 to 16384 a side and 2^26 in all");
  }
  if (header.decoded_bytes > kMaxDecodedBytes) {
    return BadImage("the image of " + size + " takes more than 2^28 bytes when decoded");
  }
  // We report errors ourselves.
  [[maybe_unused]] static const auto quiet = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    auto* data = const_cast<std::byte*>(file.data());  // imdecode only reads
    cv::Mat image = cv::imdecode(cv::Mat(1, static_cast<int>(file.size()), CV_8U, data), cv::IMREAD_UNCHANGED);
    if (image.empty()) return BadImage("the image file is corrupt");
    if (image.cols != header.width_px || image.rows != header.height_px) return BadImage("the image is not of " + size);
    return image;
  } catch (const std::exception& error) {
    return BadImage(std::string("the image file cannot be decoded: ") + error.what());
  }
}

/// Calls convert(row pointer of type Value, channels, first output pixel, number of pixels) for each row.
template <typename Value, typename Pixel, typename ConvertRow>
Image<Pixel> Convert(const cv::Mat& image, const ConvertRow& convert) {
  Image<Pixel> out{.width_px = image.cols, .height_px = image.rows, .pixels = {}};
  out.pixels.resize(image.total());
  for (int v = 0; v < image.rows; ++v) {
    convert(image.ptr<Value>(v), &out.pixels[static_cast<std::size_t>(v) * image.cols], image.cols);
  }
  return out;
}

template <typename Value>
Image<std::uint32_t> FirstChannel(const cv::Mat& image) {
  const int channels = image.channels();
  return Convert<Value, std::uint32_t>(image, [channels](const Value* in, std::uint32_t* out, int count) {
    for (int i = 0; i < count; ++i) out[i] = in[i * channels];
  });
}

}  // namespace

Result<Image<float>> DecodeDepth(std::span<const std::byte> file, double scale_m) {
  DHPMAP_ASSIGN_OR_RETURN(const cv::Mat image, Decode(file));
  if (image.type() == CV_32FC1) {
    return Convert<float, float>(image, [](const float* in, float* out, int count) { std::copy_n(in, count, out); });
  }
  if (image.type() != CV_16UC1) return BadImage("depth must be float or uint16 with 1 channel, not " + TypeName(image));
  if (!(scale_m > 0) || !std::isfinite(scale_m)) {
    return BadImage("depth is uint16, but its scale is " + std::to_string(scale_m) + " m, not positive");
  }
  return Convert<std::uint16_t, float>(image, [scale_m](const std::uint16_t* in, float* out, int count) {
    for (int i = 0; i < count; ++i) out[i] = in[i] == kNoReturn ? 0.0f : static_cast<float>(in[i] * scale_m);
  });
}

Result<Image<Color>> DecodeColor(std::span<const std::byte> file) {
  DHPMAP_ASSIGN_OR_RETURN(const cv::Mat image, Decode(file));
  const int channels = image.channels();
  if (image.depth() != CV_8U || channels == 2 || channels > 4) {
    return BadImage("colour must be 8-bit grey or colour, not " + TypeName(image));
  }
  if (channels == 1) {
    return Convert<std::uint8_t, Color>(image, [](const std::uint8_t* in, Color* out, int count) {
      for (int i = 0; i < count; ++i) out[i] = {in[i], in[i], in[i]};
    });
  }
  return Convert<std::uint8_t, Color>(image, [channels](const std::uint8_t* in, Color* out, int count) {
    for (int i = 0; i < count; ++i, in += channels) out[i] = {in[2], in[1], in[0]};  // OpenCV keeps blue first
  });
}

Result<Image<std::uint32_t>> DecodeSegments(std::span<const std::byte> file) {
  DHPMAP_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(file));
  if (header.kind == ImageKind::kJpeg) return BadImage("segment ids cannot come from JPEG, which does not keep them");
  DHPMAP_ASSIGN_OR_RETURN(const cv::Mat image, Decode(file));
  if (image.depth() == CV_8U) return FirstChannel<std::uint8_t>(image);
  if (image.depth() == CV_16U) return FirstChannel<std::uint16_t>(image);
  return BadImage("segment ids must be 8- or 16-bit grey or colour, not " + TypeName(image));
}

}  // namespace dhpmap
