// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/image_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "mapping/sensor/image_header.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using File = std::vector<std::byte>;

File Encode(const cv::Mat& image, const char* extension, const std::vector<int>& options = {}) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, image, bytes, options));
  File file(bytes.size());
  std::transform(bytes.begin(), bytes.end(), file.begin(), [](std::uint8_t b) { return std::byte{b}; });
  return file;
}

File ReadFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  File file;
  std::transform(std::istreambuf_iterator<char>(in), {}, std::back_inserter(file),
                 [](char c) { return static_cast<std::byte>(c); });
  return file;
}

/// Noise does not compress, so that every part of the file holds pixels.
cv::Mat Noise(int type) {
  cv::Mat image(48, 64, type);
  cv::RNG rng(7);
  rng.fill(image, cv::RNG::UNIFORM, 1, 200);
  return image;
}

template <typename T>
void ExpectBadImage(const Result<T>& result, const std::string& what) {
  ASSERT_FALSE(result.ok()) << what;
  EXPECT_EQ(result.status().code(), StatusCode::kInvalidArgument) << what;
  EXPECT_EQ(result.status().reason(), Reason("BAD_IMAGE")) << what;
  EXPECT_FALSE(result.status().message().empty()) << what;
}

/// Every 16th part of the file, and the file without its last bytes.
std::vector<std::size_t> CutLengths(const File& file, std::size_t tail) {
  std::vector<std::size_t> lengths;
  for (std::size_t i = 0; i < 16; ++i) lengths.push_back(file.size() * i / 16);
  for (std::size_t i = 1; i <= tail; ++i) lengths.push_back(file.size() - i);
  return lengths;
}

TEST(DecodeDepth, MultipliesUint16ByTheScaleAndTakes0And65535AsNoReturn) {
  cv::Mat image(1, 5, CV_16UC1);
  const std::uint16_t values[] = {0, 1, 1234, 65534, 65535};
  std::copy(std::begin(values), std::end(values), image.ptr<std::uint16_t>());
  const auto depth = DecodeDepth(Encode(image, ".png"), 0.001);
  ASSERT_TRUE(depth.ok()) << depth.status().ToString();
  EXPECT_EQ(depth->width_px, 5);
  EXPECT_EQ(depth->height_px, 1);
  EXPECT_EQ(depth->pixels, (std::vector<float>{0.0f, 0.001f, 1.234f, 65.534f, 0.0f}));
}

TEST(DecodeDepth, RefusesUint16WithoutAPositiveScale) {
  const File file = Encode(Noise(CV_16UC1), ".png");
  for (const double scale : {0.0, -0.001, std::nan(""), std::numeric_limits<double>::infinity()}) {
    ExpectBadImage(DecodeDepth(file, scale), std::to_string(scale));
  }
}

TEST(DecodeDepth, KeepsFloatTiffBitForBitWhateverTheScale) {
  cv::Mat image = Noise(CV_32FC1) * 0.0173;
  image.at<float>(0, 0) = std::numeric_limits<float>::quiet_NaN();
  for (const int compression : {1, 5, 8, 32946}) {  // none, LZW, deflate twice
    const auto depth = DecodeDepth(Encode(image, ".tiff", {cv::IMWRITE_TIFF_COMPRESSION, compression}), 0.0);
    ASSERT_TRUE(depth.ok()) << depth.status().ToString();
    ASSERT_EQ(depth->pixels.size(), image.total());
    EXPECT_TRUE(std::isnan(depth->pixels[0]));
    EXPECT_TRUE(std::equal(depth->pixels.begin() + 1, depth->pixels.end(), image.ptr<float>() + 1));
  }
}

TEST(DecodeDepth, RefusesOtherPixelTypes) {
  ExpectBadImage(DecodeDepth(Encode(Noise(CV_8UC1), ".png"), 0.001), "8-bit");
  ExpectBadImage(DecodeDepth(Encode(Noise(CV_16UC3), ".png"), 0.001), "16-bit colour");
  ExpectBadImage(DecodeDepth(Encode(Noise(CV_8UC3), ".jpg"), 0.001), "JPEG");
  ExpectBadImage(DecodeDepth(Encode(Noise(CV_64FC1), ".tiff"), 0.001), "double");
  ExpectBadImage(DecodeDepth(Encode(Noise(CV_32FC3), ".tiff"), 0.001), "float colour");
}

TEST(DecodeColor, GivesRedGreenBlueOfColourAndGreyAndDropsAlpha) {
  const cv::Mat bgr(2, 2, CV_8UC3, cv::Scalar(10, 20, 30));
  const cv::Mat bgra(2, 2, CV_8UC4, cv::Scalar(10, 20, 30, 128));
  const cv::Mat grey(2, 2, CV_8UC1, cv::Scalar(77));
  EXPECT_EQ(DecodeColor(Encode(bgr, ".png"))->pixels, std::vector<Color>(4, {30, 20, 10}));
  EXPECT_EQ(DecodeColor(Encode(bgra, ".png"))->pixels, std::vector<Color>(4, {30, 20, 10}));
  EXPECT_EQ(DecodeColor(Encode(grey, ".png"))->pixels, std::vector<Color>(4, {77, 77, 77}));
  EXPECT_EQ(DecodeColor(Encode(bgr, ".tiff"))->pixels, std::vector<Color>(4, {30, 20, 10}));
}

TEST(DecodeColor, ReadsJpegWithinItsLoss) {
  const cv::Mat bgr(16, 16, CV_8UC3, cv::Scalar(200, 100, 50));
  const auto color = DecodeColor(Encode(bgr, ".jpg", {cv::IMWRITE_JPEG_QUALITY, 95}));
  ASSERT_TRUE(color.ok()) << color.status().ToString();
  constexpr int kTolerance = 4;  // of chroma conversion and quantisation at quality 95
  EXPECT_NEAR(color->pixels[100].r, 50, kTolerance);
  EXPECT_NEAR(color->pixels[100].g, 100, kTolerance);
  EXPECT_NEAR(color->pixels[100].b, 200, kTolerance);
}

TEST(DecodeColor, ReadsProgressiveJpegAndJpegWithRestartMarkers) {
  const cv::Mat image = Noise(CV_8UC3);
  EXPECT_TRUE(DecodeColor(Encode(image, ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1})).ok());
  EXPECT_TRUE(DecodeColor(Encode(image, ".jpg", {cv::IMWRITE_JPEG_RST_INTERVAL, 2})).ok());
}

TEST(DecodeColor, RefusesOtherPixelTypes) {
  ExpectBadImage(DecodeColor(Encode(Noise(CV_16UC3), ".png")), "16-bit");
  ExpectBadImage(DecodeColor(Encode(Noise(CV_16UC1), ".png")), "16-bit grey");
  ExpectBadImage(DecodeColor(Encode(Noise(CV_32FC3), ".tiff")), "float");
}

TEST(DecodeSegments, TakesGreyValuesAndTheBlueChannelOfColour) {
  const cv::Mat bgr(1, 3, CV_8UC3, cv::Scalar(5, 200, 100));
  const cv::Mat bgra(1, 3, CV_8UC4, cv::Scalar(6, 200, 100, 0));
  const cv::Mat grey(1, 3, CV_8UC1, cv::Scalar(255));
  const cv::Mat grey16(1, 3, CV_16UC1, cv::Scalar(40000));
  EXPECT_EQ(DecodeSegments(Encode(bgr, ".png"))->pixels, std::vector<std::uint32_t>(3, 5));
  EXPECT_EQ(DecodeSegments(Encode(bgra, ".png"))->pixels, std::vector<std::uint32_t>(3, 6));
  EXPECT_EQ(DecodeSegments(Encode(grey, ".png"))->pixels, std::vector<std::uint32_t>(3, 255));
  EXPECT_EQ(DecodeSegments(Encode(grey16, ".png"))->pixels, std::vector<std::uint32_t>(3, 40000));
}

TEST(DecodeSegments, RefusesFloatAndJpegWhichDoesNotKeepIds) {
  ExpectBadImage(DecodeSegments(Encode(Noise(CV_32FC1), ".tiff")), "float");
  ExpectBadImage(DecodeSegments(Encode(Noise(CV_8UC1), ".jpg")), "JPEG");
}

TEST(ImageCodec, RefusesTruncatedFilesWhereverTheyAreCut) {
  const File png = Encode(Noise(CV_16UC1), ".png");
  const File jpeg = Encode(Noise(CV_8UC3), ".jpg");
  const File progressive = Encode(Noise(CV_8UC3), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  const File tiff = Encode(Noise(CV_32FC1), ".tiff");
  ASSERT_TRUE(DecodeDepth(png, 0.001).ok());
  ASSERT_TRUE(DecodeDepth(tiff, 0).ok());
  ASSERT_TRUE(DecodeColor(jpeg).ok());
  ASSERT_TRUE(DecodeColor(progressive).ok());
  const auto cut = [](const File& file, std::size_t length) { return std::span(file).first(length); };
  for (const std::size_t n : CutLengths(png, 12)) ExpectBadImage(DecodeDepth(cut(png, n), 1), std::to_string(n));
  for (const std::size_t n : CutLengths(jpeg, 4)) ExpectBadImage(DecodeColor(cut(jpeg, n)), std::to_string(n));
  for (const std::size_t n : CutLengths(progressive, 4)) {
    ExpectBadImage(DecodeColor(cut(progressive, n)), std::to_string(n));
  }
  for (const std::size_t n : CutLengths(tiff, 1)) ExpectBadImage(DecodeDepth(cut(tiff, n), 1), std::to_string(n));
}

TEST(ImageCodec, RefusesFilesWhoseStartIsGone) {
  const File png = Encode(Noise(CV_8UC3), ".png");
  for (const std::size_t skip : {1u, 8u, 100u}) ExpectBadImage(DecodeColor(std::span(png).subspan(skip)), "PNG");
}

TEST(ImageCodec, RefusesOtherKindsOfFile) {
  ExpectBadImage(DecodeColor({}), "empty");
  ExpectBadImage(DecodeColor(Encode(Noise(CV_8UC3), ".bmp")), "BMP");
  ExpectBadImage(DecodeColor(File(1000, std::byte{0x41})), "text");
}

TEST(ImageCodec, RefusesSizesThatOnlyTheHeaderClaims) {
  File png = Encode(Noise(CV_8UC3), ".png");
  png[16] = std::byte{0x7F};  // first byte of the width
  ExpectBadImage(DecodeColor(png), "width");
  const File wide = Encode(cv::Mat::zeros(1, 16385, CV_8UC1), ".png");
  ExpectBadImage(DecodeColor(wide), "16385 wide");
}

/// Where the frame header of a JPEG stands: its marker, length, precision, height, width, components.
std::size_t FrameHeaderOf(const File& jpeg) {
  for (std::size_t i = 0; i + 1 < jpeg.size(); ++i) {
    if (jpeg[i] == std::byte{0xFF} && jpeg[i + 1] == std::byte{0xC0}) return i;
  }
  ADD_FAILURE() << "no baseline frame";
  return 0;
}

/// `jpeg` with a side of 12,000 pixels in its frame header, and a second one with the true size put in before the end.
File WithSecondFrameHeader(const File& jpeg, std::vector<std::byte> before_it = {}) {
  const std::size_t sof = FrameHeaderOf(jpeg);
  const std::size_t length =
      2 + (std::to_integer<std::size_t>(jpeg[sof + 2]) << 8 | std::to_integer<std::size_t>(jpeg[sof + 3]));
  File file = jpeg;
  for (const std::size_t side : {sof + 5, sof + 7}) {
    file[side] = std::byte{12'000 >> 8};
    file[side + 1] = std::byte{12'000 & 0xFF};
  }
  before_it.insert(before_it.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(sof),
                   jpeg.begin() + static_cast<std::ptrdiff_t>(sof + length));
  file.insert(file.end() - 2, before_it.begin(), before_it.end());
  return file;
}

/// Most memory this process has had, in bytes.
std::int64_t PeakBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmPeak:")) return std::stoll(line.substr(7)) * 1024;
  }
  return 0;
}

TEST(ImageCodec, RefusesAJpegWithASecondFrameHeaderBeforeItTakesMemory) {
  const File jpeg = Encode(cv::Mat::zeros(8, 8, CV_8UC3), ".jpg");
  ASSERT_TRUE(DecodeColor(jpeg).ok());
  const std::int64_t before = PeakBytes();
  ExpectBadImage(DecodeColor(WithSecondFrameHeader(jpeg)), "two sizes");
  EXPECT_LT(PeakBytes() - before, 100'000'000) << "432 MB is what the first header asks for";
}

TEST(ImageCodec, SeesAFrameHeaderBehindAMarkerThatStandsAlone) {
  // TEM has no length. Read as if it had one, the first header is skipped and the second believed.
  const File jpeg = Encode(cv::Mat::zeros(8, 8, CV_8UC3), ".jpg");
  File hidden{std::byte{0xFF}, std::byte{0xD8}, std::byte{0xFF}, std::byte{0x01}};
  const std::size_t sof = FrameHeaderOf(jpeg);
  File header(jpeg.begin() + static_cast<std::ptrdiff_t>(sof), jpeg.begin() + static_cast<std::ptrdiff_t>(sof + 19));
  // What follows TEM, 0xFFC0, would be a length of 65,472.
  hidden.insert(hidden.end(), header.begin(), header.end());
  hidden.resize(4 + 0xFFC0, std::byte{0});
  hidden.insert(hidden.end(), jpeg.begin() + 2, jpeg.end());
  ExpectBadImage(ReadImageHeader(hidden), "hidden header");
}

std::int64_t DecodedBytesOf(const File& file) {
  const auto header = ReadImageHeader(file);
  EXPECT_TRUE(header.ok());
  return header.ok() ? header->decoded_bytes : -1;
}

void ExpectTooManyBytes(const Status& status) {
  EXPECT_EQ(status.reason(), Reason("BAD_IMAGE"));
  EXPECT_NE(status.message().find("2^28 bytes"), std::string::npos) << status.ToString();
}

TEST(ImageCodec, KnowsBeforehandWhatDecodingTakes) {
  constexpr std::int64_t kPixels = 48 * 64;
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_8UC1), ".png")), kPixels);
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_16UC1), ".png")), kPixels * 2);
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_16UC4), ".png")), kPixels * 8);
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_8UC3), ".jpg")), kPixels * 3);
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_8UC3), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1})), kPixels * 9);
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_32FC1), ".tiff")), kPixels * 4);
  EXPECT_EQ(DecodedBytesOf(Encode(Noise(CV_64FC1), ".tiff")), kPixels * 8);
}

TEST(ImageCodec, RefusesWhatTakesMoreThan256MiBDecodedThoughItsPixelsAreFewEnough) {
  File png = Encode(Noise(CV_16UC4), ".png");
  for (const std::size_t side : {16u, 20u}) {  // 8191 x 8191, the checksum no longer right
    png[side + 2] = std::byte{0x1F};
    png[side + 3] = std::byte{0xFF};
  }
  ExpectTooManyBytes(DecodeColor(png).status());
}

TEST(ImageCodec, RefusesTilesLargerThanTheImage) {
  File tiff = Encode(Noise(CV_32FC1), ".tiff");
  // Turn two entries of the directory that decoding does without into the size of a tile: 16,000 a side.
  const auto entry_of = [&tiff](int tag) {
    const auto at = [&tiff](std::size_t i) { return std::to_integer<std::size_t>(tiff[i]); };
    const std::size_t directory = at(4) | at(5) << 8 | at(6) << 16 | at(7) << 24;
    for (std::size_t i = 0; i < (at(directory) | at(directory + 1) << 8); ++i) {
      const std::size_t entry = directory + 2 + 12 * i;
      if ((at(entry) | at(entry + 1) << 8) == static_cast<std::size_t>(tag)) return entry;
    }
    return std::size_t{0};
  };
  const auto set = [&tiff](std::size_t entry, std::uint16_t tag, std::uint16_t value, std::uint16_t type) {
    const std::uint16_t words[] = {tag, type, 1, 0, value, 0};
    for (std::size_t i = 0; i < 6; ++i) {
      tiff[entry + 2 * i] = static_cast<std::byte>(words[i] & 0xFF);
      tiff[entry + 2 * i + 1] = static_cast<std::byte>(words[i] >> 8);
    }
  };
  ASSERT_EQ(tiff[0], std::byte{'I'});
  const std::size_t first = entry_of(284), second = entry_of(278);  // planar configuration, rows a strip
  ASSERT_NE(first, 0u);
  ASSERT_NE(second, 0u);
  ASSERT_TRUE(DecodeDepth(tiff, 0).ok());
  constexpr std::uint16_t kShort = 3, kSignedShort = 8, kSignedLong = 9;
  set(first, 322, 16'000, kShort);
  set(second, 323, 16'000, kShort);
  ExpectTooManyBytes(DecodeDepth(tiff, 0).status());
  for (const std::uint16_t type : {kSignedShort, kSignedLong}) {  // which libtiff reads as well
    set(first, 322, 16'000, type);
    ExpectBadImage(DecodeDepth(tiff, 0), "neither SHORT nor LONG");
  }
}

TEST(ImageCodec, SurvivesEveryFlippedByteOfSmallFiles) {
  cv::Mat small(4, 5, CV_8UC3, cv::Scalar(1, 2, 3));
  for (const char* extension : {".png", ".jpg", ".tiff"}) {
    const File good = Encode(small, extension);
    for (std::size_t i = 0; i < good.size(); ++i) {
      File bad = good;
      bad[i] ^= std::byte{0xFF};
      const auto color = DecodeColor(bad);  // may succeed, must not crash, and keeps its promise if it does
      if (color.ok()) {
        EXPECT_EQ(color->pixels.size(), static_cast<std::size_t>(color->width_px) * color->height_px);
        const bool is_checksummed = std::string_view(extension) == ".png";
        EXPECT_TRUE(!is_checksummed || color->pixels == DecodeColor(good)->pixels) << "byte " << i;
      }
    }
  }
}

TEST(ImageCodec, ReadsTheFlatDataSet) {
  const auto folder = testing::SharedDataDir() / "house" / "run1";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data here";
  const auto depth = DecodeDepth(ReadFile(folder / "000000_depth.tiff"), 0);
  ASSERT_TRUE(depth.ok()) << depth.status().ToString();
  EXPECT_EQ(depth->width_px, 640);
  EXPECT_EQ(depth->height_px, 480);
  const auto in_room =
      std::count_if(depth->pixels.begin(), depth->pixels.end(), [](float z) { return z > 0 && z < 30; });
  EXPECT_GT(in_room, 200'000);
  const auto color = DecodeColor(ReadFile(folder / "000000_color.png"));
  const auto segments = DecodeSegments(ReadFile(folder / "000000_segmentation.png"));
  ASSERT_TRUE(color.ok() && segments.ok());
  EXPECT_EQ(color->pixels.size(), 307'200u);
  EXPECT_LT(*std::max_element(segments->pixels.begin(), segments->pixels.end()), 256u);

  const File tiff = ReadFile(folder / "000000_depth.tiff");
  for (const std::size_t n : CutLengths(tiff, 1)) {
    ExpectBadImage(DecodeDepth(std::span(tiff).first(n), 0), std::to_string(n));
  }
}

}  // namespace
}  // namespace dhpmap
