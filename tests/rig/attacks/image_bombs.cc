// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/image_bombs.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <utility>
#include <vector>

#include "mapping/images/png.h"

namespace dhpmap::rig {
namespace {

void Append(std::string& file, std::initializer_list<int> bytes) {
  for (const int byte : bytes) file += static_cast<char>(byte);
}

void AppendLittle(std::string& file, std::uint32_t value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) file += static_cast<char>(value >> (8 * i) & 0xFF);
}

void PutBig(std::string& file, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<char>(value >> (24 - 8 * i) & 0xFF);
}

void AppendJpegFrame(std::string& file, int width_px, int height_px) {
  Append(file, {0xFF, 0xC0, 0, 11, 8, height_px >> 8, height_px & 0xFF, width_px >> 8, width_px & 0xFF, 1, 1, 0x11, 0});
}

/// With one code, of one bit, for 0: no change of the mean; the end of a block.
void AppendJpegTable(std::string& file, int table) {
  Append(file, {0xFF, 0xC4, 0, 20, table, 1});
  file.append(15 + 1, '\0');
}

/// `second_px` 0: with one frame header.
std::string Jpeg(int width_px, int height_px, int second_px) {
  constexpr int kDc = 0x00, kAc = 0x10;
  std::string file;
  Append(file, {0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0});
  file.append(64, '\1');
  AppendJpegFrame(file, width_px, height_px);
  if (second_px > 0) AppendJpegFrame(file, second_px, second_px);
  AppendJpegTable(file, kDc);
  AppendJpegTable(file, kAc);
  Append(file, {0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0});
  const auto num_blocks = static_cast<std::size_t>((width_px + 7) / 8) * static_cast<std::size_t>((height_px + 7) / 8);
  file.append((2 * num_blocks + 7) / 8, '\0');
  Append(file, {0xFF, 0xD9});
  return file;
}

/// Of a PNG's chunk (ISO/IEC 15948, annex D).
std::uint32_t ChecksumOf(const std::string& file, std::size_t begin, std::size_t end) {
  std::uint32_t sum = 0xFFFFFFFF;
  for (std::size_t i = begin; i < end; ++i) {
    sum ^= static_cast<unsigned char>(file[i]);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xEDB88320u : 0u);
  }
  return ~sum;
}

}  // namespace

std::string SmallTiff(int width_px, int height_px) {
  constexpr std::uint32_t kShort = 3, kLong = 4, kNumFields = 9, kDirectory = 8, kPackBits = 32773;
  const auto width = static_cast<std::uint32_t>(width_px), height = static_cast<std::uint32_t>(height_px);
  const std::uint32_t runs_a_row = (2 * width + 127) / 128;
  const std::uint32_t offsets = kDirectory + 2 + 12 * kNumFields + 4, lengths = offsets + 4 * height;
  const std::uint32_t row = lengths + 4 * height;
  std::string file("II*\0", 4);
  AppendLittle(file, kDirectory, 4);
  AppendLittle(file, kNumFields, 2);
  const auto append_field = [&file](std::uint32_t tag, std::uint32_t type, std::uint32_t count, std::uint32_t value) {
    AppendLittle(file, tag, 2);
    AppendLittle(file, type, 2);
    AppendLittle(file, count, 4);
    AppendLittle(file, value, 4);
  };
  append_field(256, kLong, 1, width);
  append_field(257, kLong, 1, height);
  append_field(258, kShort, 1, 16);         // bits a sample
  append_field(259, kShort, 1, kPackBits);  // compression
  append_field(262, kShort, 1, 1);          // 0 is black
  append_field(273, kLong, height, offsets);
  append_field(277, kShort, 1, 1);  // samples a pixel
  append_field(278, kLong, 1, 1);   // rows a strip
  append_field(279, kLong, height, lengths);
  AppendLittle(file, 0, 4);  // no other image
  for (int v = 0; v < height_px; ++v) AppendLittle(file, row, 4);
  for (int v = 0; v < height_px; ++v) AppendLittle(file, 2 * runs_a_row, 4);
  for (std::uint32_t run = 0; run < runs_a_row; ++run) Append(file, {0x81, 0});  // 128 times 0
  return file;
}

std::string SmallJpeg(int width_px, int height_px) { return Jpeg(width_px, height_px, 0); }

std::string JpegOfTwoSizes(int width_px, int height_px, int second_px) { return Jpeg(width_px, height_px, second_px); }

std::string SmallPng(int width_px, int height_px) {
  const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  auto file = EncodePng(pixels, width_px, height_px);
  if (!file.ok()) std::abort();
  return std::move(*file);
}

std::string EmptyPng(int width_px, int height_px) {
  constexpr std::size_t kType = 12, kWidth = 16, kHeight = 20, kChecksum = 29;  // of IHDR, which comes first
  std::string file = SmallPng(8, 1);
  PutBig(file, kWidth, static_cast<std::uint32_t>(width_px));
  PutBig(file, kHeight, static_cast<std::uint32_t>(height_px));
  PutBig(file, kChecksum, ChecksumOf(file, kType, kChecksum));
  return file;
}

}  // namespace dhpmap::rig
