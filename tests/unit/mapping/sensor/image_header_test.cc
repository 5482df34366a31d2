// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/image_header.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace dhpmap {
namespace {

using File = std::vector<std::byte>;

File Bytes(std::initializer_list<int> values) {
  File file;
  for (const int value : values) file.push_back(static_cast<std::byte>(value));
  return file;
}

File Joined(std::initializer_list<File> parts) {
  File file;
  for (const File& part : parts) file.insert(file.end(), part.begin(), part.end());
  return file;
}

// The smallest files of each kind; headers and frames only, for nothing is decoded.

const File kPngEnd = Bytes({0, 0, 0, 0, 'I', 'E', 'N', 'D', 0, 0, 0, 0});

File Png(int bit_depth, int color_type, std::initializer_list<int> width = {0, 0, 1, 2}) {
  return Joined({Bytes({0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R'}), Bytes(width),
                 Bytes({0, 0, 0, 3, bit_depth, color_type, 0, 0, 0, 0, 0, 0, 0}), kPngEnd});
}

File JpegFrame(int marker, int width) {
  return Bytes({0xFF, marker, 0, 11, 8, 0, 3, width >> 8, width & 0xFF, 1, 1, 0x11, 0});
}
const File kJpegStart = Bytes({0xFF, 0xD8});
const File kJpegScan = Bytes({0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0x12, 0xFF, 0x00, 0xFF, 0xD0, 0x34});
const File kJpegEnd = Bytes({0xFF, 0xD9});

/// 4 x 3 pixels of one byte, in one strip at the end.
File Tiff(bool is_big_endian, int strip_bytes = 12) {
  File file = is_big_endian ? Bytes({'M', 'M', 0, 42}) : Bytes({'I', 'I', 42, 0});
  const auto put = [&](std::uint32_t value, int num_bytes) {
    for (int i = 0; i < num_bytes; ++i) {
      const int shift = 8 * (is_big_endian ? num_bytes - 1 - i : i);
      file.push_back(static_cast<std::byte>(value >> shift));
    }
  };
  const auto entry = [&](std::uint32_t tag, std::uint32_t value) {
    put(tag, 2);
    put(4, 2);  // LONG
    put(1, 4);
    put(value, 4);
  };
  put(8, 4);
  put(4, 2);
  entry(256, 4);
  entry(257, 3);
  entry(273, 8 + 2 + 4 * 12 + 4);
  entry(279, static_cast<std::uint32_t>(strip_bytes));
  put(0, 4);
  file.resize(file.size() + 12);
  return file;
}

void ExpectBad(const File& file, const std::string& what) {
  const auto header = ReadImageHeader(file);
  ASSERT_FALSE(header.ok()) << what;
  EXPECT_EQ(header.status().reason(), Reason("BAD_IMAGE")) << what;
}

TEST(ImageHeader, TellsKindAndSize) {
  const auto png = ReadImageHeader(Png(8, 0));
  ASSERT_TRUE(png.ok()) << png.status().message();
  EXPECT_EQ(png->kind, ImageKind::kPng);
  EXPECT_EQ(png->width_px, 258);
  EXPECT_EQ(png->height_px, 3);
  const auto jpeg = ReadImageHeader(Joined({kJpegStart, JpegFrame(0xC0, 258), kJpegScan, kJpegEnd}));
  ASSERT_TRUE(jpeg.ok()) << jpeg.status().message();
  EXPECT_EQ(jpeg->kind, ImageKind::kJpeg);
  EXPECT_EQ(jpeg->width_px, 258);
  EXPECT_EQ(jpeg->height_px, 3);
  for (const bool is_big_endian : {false, true}) {
    const auto tiff = ReadImageHeader(Tiff(is_big_endian));
    ASSERT_TRUE(tiff.ok()) << tiff.status().message();
    EXPECT_EQ(tiff->kind, ImageKind::kTiff);
    EXPECT_EQ(tiff->width_px, 4);
    EXPECT_EQ(tiff->height_px, 3);
  }
}

TEST(ImageHeader, EveryFileThatIsCutOffIsRefused) {
  for (const File& whole :
       {Png(8, 0), Joined({kJpegStart, JpegFrame(0xC0, 9), kJpegScan, kJpegEnd}), Tiff(false), Tiff(true)}) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      // What follows IEND's type is a checksum that nobody reads; it belongs to the file all the same.
      ExpectBad(File(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)),
                std::to_string(length) + " of " + std::to_string(whole.size()));
    }
  }
}

TEST(ImageHeader, CountsChannelsAndDepthOfAPng) {
  EXPECT_EQ(ReadImageHeader(Png(8, 0))->decoded_bytes, 258 * 3);
  EXPECT_EQ(ReadImageHeader(Png(16, 0))->decoded_bytes, 258 * 3 * 2);
  EXPECT_EQ(ReadImageHeader(Png(8, 2))->decoded_bytes, 258 * 3 * 4);
  EXPECT_EQ(ReadImageHeader(Png(1, 3))->decoded_bytes, 258 * 3 * 4) << "a palette may have alpha";
}

TEST(ImageHeader, SizesBeyondAllNumbersAreVeryLargeNotNegative) {
  const auto header = ReadImageHeader(Png(16, 6, {0xFF, 0xFF, 0xFF, 0xFF}));
  ASSERT_TRUE(header.ok());
  EXPECT_EQ(header->width_px, 4294967295);
  EXPECT_GT(header->decoded_bytes, std::int64_t{1} << 32);
}

TEST(ImageHeader, AProgressiveJpegAndOneOfSeveralScansKeepTheirCoefficients) {
  const auto bytes = [](const File& file) { return ReadImageHeader(file)->decoded_bytes; };
  const std::int64_t plain = bytes(Joined({kJpegStart, JpegFrame(0xC0, 9), kJpegScan, kJpegEnd}));
  EXPECT_EQ(plain, 9 * 3);
  EXPECT_EQ(bytes(Joined({kJpegStart, JpegFrame(0xC2, 9), kJpegScan, kJpegEnd})), 3 * plain);
  EXPECT_EQ(bytes(Joined({kJpegStart, JpegFrame(0xC0, 9), kJpegScan, kJpegScan, kJpegEnd})), 3 * plain);
}

TEST(ImageHeader, AFileThatSaysItTwiceOrNotAtAllIsRefused) {
  ExpectBad(Joined({kJpegStart, JpegFrame(0xC0, 9), JpegFrame(0xC0, 8), kJpegScan, kJpegEnd}), "two frames");
  ExpectBad(Joined({kJpegStart, JpegFrame(0xC0, 9), kJpegScan, JpegFrame(0xC2, 8), kJpegEnd}), "one after the scan");
  ExpectBad(Joined({kJpegStart, JpegFrame(0xC0, 9), kJpegEnd}), "no scan");
  ExpectBad(Joined({kJpegStart, kJpegEnd}), "nothing");
}

TEST(ImageHeader, AStripMustLieInsideTheFile) {
  EXPECT_TRUE(ReadImageHeader(Tiff(false, 12)).ok());
  ExpectBad(Tiff(false, 13), "one byte too long");
  ExpectBad(Tiff(true, -1), "4 GiB");
}

TEST(ImageHeader, OtherFilesAreRefused) {
  ExpectBad({}, "empty");
  ExpectBad(Bytes({'B', 'M', 0, 0, 0, 0}), "BMP");
  ExpectBad(Bytes({'I', 'I', 43, 0, 8, 0, 0, 0}), "BigTIFF");
  ExpectBad(Joined({Bytes({0}), Png(8, 0)}), "PNG behind another byte");
}

}  // namespace
}  // namespace dhpmap
