// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/labels/color.h"

namespace dhpmap::evaluator {

/// Pixels, row by row from the top.
struct Picture {
  int width_px = 0, height_px = 0;
  std::vector<Color> pixels;

  Picture() = default;
  Picture(int width, int height, Color background);
  [[nodiscard]] Color& at(int x, int y) { return pixels[Index(x, y)]; }
  [[nodiscard]] const Color& at(int x, int y) const { return pixels[Index(x, y)]; }

 private:
  [[nodiscard]] std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x);
  }
};

/// Stacks two pictures vertically, on white.
Picture Below(const Picture& top, const Picture& bottom);

/// Encodes as PNG, or as JPEG, which takes a fifth of the size and blurs colours a little.
enum class PictureFormat { kPng, kJpeg };
std::string Encode(const Picture& picture, PictureFormat format);

}  // namespace dhpmap::evaluator
