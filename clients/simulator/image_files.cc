// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/image_files.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dhpmap::simulator {
namespace {

Status Write(const std::filesystem::path& path, const cv::Mat& image, const std::vector<int>& settings) {
  try {
    if (cv::imwrite(path.string(), image, settings)) return Status::Ok();
    return Unavailable("cannot write " + path.string());
  } catch (const cv::Exception& error) {
    return Unavailable("cannot write " + path.string() + ": " + error.what());
  }
}

/// A view of the pixels, which OpenCV only reads.
template <typename Pixel>
cv::Mat View(int width_px, std::span<const Pixel> pixels, int type) {
  const int height = static_cast<int>(pixels.size()) / width_px;
  return {height, width_px, type, const_cast<Pixel*>(pixels.data())};
}

const std::vector<int>& FastPng() {
  static const std::vector<int> settings{cv::IMWRITE_PNG_COMPRESSION, 1};
  return settings;
}

}  // namespace

Status WriteColorPng(const std::filesystem::path& path, int width_px, std::span<const Rgb> pixels) {
  static_assert(sizeof(Rgb) == 3);
  cv::Mat bgr;
  cv::cvtColor(View(width_px, pixels, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  return Write(path, bgr, FastPng());
}

Status WriteIdPng(const std::filesystem::path& path, int width_px, std::span<const std::uint8_t> ids) {
  return Write(path, View(width_px, ids, CV_8UC1), FastPng());
}

Status WriteDepthTiff(const std::filesystem::path& path, int width_px, std::span<const float> depth_m) {
  constexpr int kNone = 1;  // COMPRESSION_NONE of libtiff
  return Write(path, View(width_px, depth_m, CV_32FC1), {cv::IMWRITE_TIFF_COMPRESSION, kNone});
}

}  // namespace dhpmap::simulator
