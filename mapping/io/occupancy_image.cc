// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/occupancy_image.h"

#include <cstdio>
#include <utility>
#include <vector>

#include "mapping/images/png.h"

namespace dhpmap {
namespace {

// As written by nav2's map_saver. Its loader treats p = 1 - grey / 255 as occupied above occupied_thresh and as free
// below free_thresh. 205 is 0.1961: unknown for the threshold below, but free for the 0.25 in some files.
constexpr unsigned char kFreeGrey = 254, kOccupiedGrey = 0, kUnknownGrey = 205;
constexpr const char* kThresholds = "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

unsigned char GreyOf(std::int8_t cell) {
  if (cell == 100) return kOccupiedGrey;
  return cell == 0 ? kFreeGrey : kUnknownGrey;
}

/// Pixels from the top row down.
std::vector<unsigned char> PixelsOf(std::span<const std::int8_t> cells, int width, int height) {
  std::vector<unsigned char> pixels;
  pixels.reserve(cells.size());
  const auto row_length = static_cast<std::size_t>(width);
  for (auto y = static_cast<std::size_t>(height); y-- > 0;) {
    for (const std::int8_t cell : cells.subspan(y * row_length, row_length)) pixels.push_back(GreyOf(cell));
  }
  return pixels;
}

/// With full precision, in a form that no YAML reader takes for text.
std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9f", value);
  std::string number = text;
  while (number.back() == '0' && number[number.size() - 2] != '.') number.pop_back();
  return number;
}

/// In single quotes, where only quotes need escaping.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string PgmOf(std::span<const std::int8_t> cells, int width, int height) {
  std::string file = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  const std::vector<unsigned char> pixels = PixelsOf(cells, width, height);
  file.append(pixels.begin(), pixels.end());
  return file;
}

Result<std::string> PngOf(std::span<const std::int8_t> cells, int width, int height) {
  return EncodePng(PixelsOf(cells, width, height), width, height);
}

std::string MapYaml(const std::string& image, double resolution_m, const Eigen::Vector2d& min_m) {
  return "image: " + Quoted(image) + "\nmode: trinary\nresolution: " + Number(resolution_m) + "\norigin: [" +
         Number(min_m.x()) + ", " + Number(min_m.y()) + ", 0.0]\nnegate: 0\n" + kThresholds;
}

}  // namespace dhpmap
