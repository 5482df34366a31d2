// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/picture.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace dhpmap::evaluator {
namespace {

constexpr Color kWhite{255, 255, 255};

void Paste(const Picture& part, int top_px, Picture& whole) {
  for (int y = 0; y < part.height_px; ++y) {
    for (int x = 0; x < part.width_px; ++x) whole.at(x, top_px + y) = part.at(x, y);
  }
}

}  // namespace

Picture::Picture(int width, int height, Color background)
    : width_px(width),
      height_px(height),
      pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

Picture Below(const Picture& top, const Picture& bottom) {
  Picture both(std::max(top.width_px, bottom.width_px), top.height_px + bottom.height_px, kWhite);
  Paste(top, 0, both);
  Paste(bottom, top.height_px, both);
  return both;
}

std::string Encode(const Picture& picture, PictureFormat format) {
  constexpr int kQuality = 90;
  cv::Mat image(picture.height_px, picture.width_px, CV_8UC3);
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const Color& color = picture.at(x, y);
      image.at<cv::Vec3b>(y, x) = {color.b, color.g, color.r};
    }
  }
  std::vector<unsigned char> bytes;
  if (format == PictureFormat::kPng) cv::imencode(".png", image, bytes);
  else cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return {bytes.begin(), bytes.end()};
}

}  // namespace dhpmap::evaluator
