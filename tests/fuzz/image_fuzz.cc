// SPDX-License-Identifier: BSD-3-Clause
// Image files from strangers: refused or decoded to what their header says.
#include <opencv2/imgcodecs.hpp>
#include <span>

#include "mapping/sensor/image_codec.h"
#include "mapping/sensor/image_header.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kMaxPixels = 1 << 20;  // larger ones are right, but slow

std::string Encoded(const char* extension, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

template <typename Pixel>
void RequireSize(const Result<Image<Pixel>>& image, const ImageHeader& header) {
  if (!image.ok()) return;
  fuzz::Require(image->width_px == header.width_px && image->height_px == header.height_px);
  fuzz::Require(image->pixels.size() == static_cast<std::size_t>(header.width_px * header.height_px));
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  cv::Mat color(9, 13, CV_8UC3, cv::Scalar(10, 200, 30)), depth(9, 13, CV_16UC1, cv::Scalar(1500));
  cv::Mat metres(9, 13, CV_32FC1, cv::Scalar(1.5)), ids(9, 13, CV_8UC1, cv::Scalar(3));
  return {Encoded(".png", color),   Encoded(".jpg", color),  Encoded(".png", depth), Encoded(".tiff", depth),
          Encoded(".tiff", metres), Encoded(".tiff", color), Encoded(".png", ids)};
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  const auto file = std::as_bytes(std::span(data, size));
  const Result<ImageHeader> header = ReadImageHeader(file);
  if (header.ok() && header->width_px > 0 && header->height_px > kMaxPixels / header->width_px) return 0;
  const auto depth = DecodeDepth(file, 0.001);
  const auto color = DecodeColor(file);
  const auto segments = DecodeSegments(file);
  if (!header.ok()) {
    fuzz::Require(!depth.ok() && !color.ok() && !segments.ok());
    return 0;
  }
  RequireSize(depth, *header);
  RequireSize(color, *header);
  RequireSize(segments, *header);
  return 0;
}
