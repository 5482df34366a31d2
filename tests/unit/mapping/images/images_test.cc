// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <spng.h>
#include <sys/resource.h>
#include <tiffio.h>
#include <turbojpeg.h>

#include <array>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "mapping/images/jpeg.h"
#include "mapping/images/png.h"
#include "mapping/images/tiff.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using Bytes = std::vector<std::uint8_t>;

cv::Mat Noise(int type) {
  cv::Mat image(33, 47, type);
  cv::RNG rng(5);
  rng.fill(image, cv::RNG::UNIFORM, 0, image.depth() == CV_16U ? 65536 : 256);
  return image;
}

Bytes Encode(const cv::Mat& image, const char* extension, const std::vector<int>& options = {}) {
  Bytes file;
  EXPECT_TRUE(cv::imencode(extension, image, file, options));
  return file;
}

Result<DecodedImage> Png(const Bytes& file) { return DecodePng(std::as_bytes(std::span(file))); }
Result<DecodedImage> Tiff(const Bytes& file) { return DecodeTiff(std::as_bytes(std::span(file))); }
Result<DecodedImage> Jpeg(const Bytes& file) { return DecodeJpeg(std::as_bytes(std::span(file))); }

/// The channels of `image` as OpenCV has them: blue first.
template <typename Sample>
void ExpectPixels(const DecodedImage& image, const cv::Mat& expected) {
  ASSERT_EQ(image.width_px, expected.cols);
  ASSERT_EQ(image.height_px, expected.rows);
  ASSERT_EQ(image.num_channels, expected.channels());
  int num_wrong = 0;
  for (int v = 0; v < expected.rows; ++v) {
    const auto* theirs = expected.ptr<Sample>(v);
    for (int i = 0; i < expected.cols * image.num_channels; ++i) {
      const int channel = i % image.num_channels;
      const int twin = image.num_channels >= 3 && channel != 1 && channel < 3 ? i - channel + (2 - channel) : i;
      num_wrong += image.Row<Sample>(v)[i] != theirs[twin];
    }
  }
  EXPECT_EQ(num_wrong, 0);
}

template <typename Sample>
void ExpectPngAsOpenCv(SampleType type, std::initializer_list<int> kinds) {
  for (const int kind : kinds) {
    const cv::Mat image = Noise(kind);
    const auto decoded = Png(Encode(image, ".png"));
    ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
    EXPECT_EQ(decoded->type, type);
    ExpectPixels<Sample>(*decoded, image);
  }
}

TEST(DecodePng, GivesWhatOpenCvGives) {
  ExpectPngAsOpenCv<std::uint8_t>(SampleType::kUint8, {CV_8UC1, CV_8UC3, CV_8UC4});
  ExpectPngAsOpenCv<std::uint16_t>(SampleType::kUint16, {CV_16UC1, CV_16UC3, CV_16UC4});
}

/// A PNG of 8 pixels in a row, of a kind that OpenCV does not write.
Bytes SmallPng(spng_color_type color, std::uint8_t bit_depth, const Bytes& pixels, const std::string& text = {}) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{8, 1, bit_depth, static_cast<std::uint8_t>(color), 0, 0, 0};
  EXPECT_EQ(spng_set_ihdr(context.get(), &header), 0);
  spng_plte palette{};
  palette.n_entries = 4;
  for (std::uint32_t i = 0; i < 4; ++i) {
    palette.entries[i] = {static_cast<std::uint8_t>(10 * i), static_cast<std::uint8_t>(20 * i),
                          static_cast<std::uint8_t>(30 * i), 255};
  }
  const bool has_palette = color == SPNG_COLOR_TYPE_INDEXED;
  EXPECT_EQ(has_palette ? spng_set_plte(context.get(), &palette) : 0, 0);
  std::string copy = text;
  spng_text chunk{};
  std::strcpy(chunk.keyword, "Comment");
  chunk.type = SPNG_ZTXT;
  chunk.text = copy.data();
  chunk.length = copy.size();
  EXPECT_EQ(text.empty() ? 0 : spng_set_text(context.get(), &chunk, 1), 0);
  EXPECT_EQ(spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  std::size_t num_bytes = 0;
  int error = 0;
  const std::unique_ptr<void, decltype(&std::free)> file(spng_get_png_buffer(context.get(), &num_bytes, &error),
                                                         &std::free);
  const auto* begin = static_cast<const std::uint8_t*>(file.get());
  return {begin, begin + num_bytes};
}

TEST(DecodePng, SpreadsFewBitsAndPutsColoursInPlaceOfAPalette) {
  const Bytes grey = SmallPng(SPNG_COLOR_TYPE_GRAYSCALE, 2, {0b00011011, 0b11100100});
  const Bytes palette = SmallPng(SPNG_COLOR_TYPE_INDEXED, 2, {0b00011011, 0b11100100});
  for (const Bytes& file : {grey, palette}) {
    const cv::Mat theirs = cv::imdecode(file, cv::IMREAD_UNCHANGED);
    const auto decoded = Png(file);
    ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
    ExpectPixels<std::uint8_t>(*decoded, theirs);
  }
  EXPECT_EQ(Png(grey)->Row<std::uint8_t>(0)[1], 85);
  EXPECT_EQ(Png(palette)->Row<std::uint8_t>(0)[3], 10);
}

TEST(DecodePng, TakesGreyWithAlphaAsColour) {
  const auto decoded = Png(SmallPng(SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 8, Bytes(16, 77)));
  ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
  EXPECT_EQ(decoded->num_channels, 4);
  const auto* row = decoded->Row<std::uint8_t>(0);
  EXPECT_EQ((std::array{row[28], row[29], row[30], row[31]}), (std::array<std::uint8_t, 4>{77, 77, 77, 77}));
}

TEST(DecodePng, RefusesTextThatUnpacksToAnySize) {
  const Bytes pixels(8, 1);
  EXPECT_TRUE(Png(SmallPng(SPNG_COLOR_TYPE_GRAYSCALE, 8, pixels, std::string(1000, 'a'))).ok());
  std::string much;
  much.resize(64'000'000, 'a');
  const Bytes file = SmallPng(SPNG_COLOR_TYPE_GRAYSCALE, 8, pixels, much);
  EXPECT_LT(file.size(), 100'000u);
  EXPECT_EQ(Png(file).status().reason(), Reason("BAD_IMAGE"));
}

TEST(DecodePng, RefusesWhatIsDamaged) {
  const Bytes good = Encode(Noise(CV_16UC1), ".png");
  EXPECT_EQ(Png({}).status().reason(), Reason("BAD_IMAGE"));
  for (std::size_t i = 8; i + 12 < good.size(); i += 7) {
    Bytes bad = good;
    bad[i] ^= 0x10;
    const auto decoded = Png(bad);
    EXPECT_EQ(decoded.status().reason(), Reason("BAD_IMAGE")) << "byte " << i;
  }
}

TEST(EncodePng, IsReadByOpenCvAndByUs) {
  const cv::Mat image = Noise(CV_8UC1);
  const auto file = EncodePng({image.data, image.total()}, image.cols, image.rows);
  ASSERT_TRUE(file.ok()) << file.status().ToString();
  const Bytes bytes(file->begin(), file->end());
  EXPECT_EQ(cv::norm(cv::imdecode(bytes, cv::IMREAD_UNCHANGED), image, cv::NORM_INF), 0);
  ExpectPixels<std::uint8_t>(*Png(bytes), image);
}

TEST(DecodeJpeg, GivesWhatOpenCvGives) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const int is_progressive : {0, 1}) {
      const Bytes file = Encode(Noise(type), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, is_progressive});
      const auto decoded = Jpeg(file);
      ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
      EXPECT_EQ(decoded->type, SampleType::kUint8);
      ExpectPixels<std::uint8_t>(*decoded, cv::imdecode(file, cv::IMREAD_UNCHANGED));
    }
  }
}

TEST(DecodeJpeg, RefusesColoursOfPrintAndWhatIsNoJpeg) {
  const Bytes pixels(std::size_t{16} * 16 * 4, 100);
  const std::unique_ptr<void, decltype(&tjDestroy)> handle(tjInitCompress(), &tjDestroy);
  unsigned char* file = nullptr;
  unsigned long num_bytes = 0;
  ASSERT_EQ(tjCompress2(handle.get(), pixels.data(), 16, 0, 16, TJPF_CMYK, &file, &num_bytes, TJSAMP_444, 90, 0), 0);
  const Bytes print(file, file + num_bytes);
  tjFree(file);
  EXPECT_EQ(Jpeg(print).status().reason(), Reason("BAD_IMAGE"));
  EXPECT_NE(Jpeg(print).status().message().find("CMYK"), std::string::npos);
  EXPECT_EQ(Jpeg({}).status().reason(), Reason("BAD_IMAGE"));
  EXPECT_EQ(Jpeg(Bytes(100, 0x41)).status().reason(), Reason("BAD_IMAGE"));
  EXPECT_EQ(Jpeg(Bytes(print.begin(), print.begin() + 20)).status().reason(), Reason("BAD_IMAGE"));
}

constexpr int kNone = 1, kLzw = 5, kJpeg = 7, kDeflate = 8, kOldDeflate = 32946, kPackBits = 32773;

Bytes TiffOf(const cv::Mat& image, int compression) {
  return Encode(image, ".tiff", {cv::IMWRITE_TIFF_COMPRESSION, compression});
}

TEST(DecodeTiff, GivesWhatOpenCvGives) {
  for (const int compression : {kNone, kLzw, kDeflate, kOldDeflate, kPackBits}) {
    for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
      const auto decoded = Tiff(TiffOf(Noise(type), compression));
      ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
      EXPECT_EQ(decoded->type, SampleType::kUint8);
      ExpectPixels<std::uint8_t>(*decoded, Noise(type));
    }
    const auto deep = Tiff(TiffOf(Noise(CV_16UC1), compression));
    ASSERT_TRUE(deep.ok()) << deep.status().ToString();
    EXPECT_EQ(deep->type, SampleType::kUint16);
    ExpectPixels<std::uint16_t>(*deep, Noise(CV_16UC1));
    cv::Mat depth_m;
    Noise(CV_16UC1).convertTo(depth_m, CV_32F, 0.0173);
    const auto real = Tiff(TiffOf(depth_m, compression));
    ASSERT_TRUE(real.ok()) << real.status().ToString();
    EXPECT_EQ(real->type, SampleType::kFloat);
    ExpectPixels<float>(*real, depth_m);
  }
}

long PeakMemory_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

Bytes Content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(DecodeTiff, PutsTilesTogether) {
  const testing::TempDir folder;
  const std::string path = (folder.path() / "tiles.tiff").string();
  const cv::Mat image = Noise(CV_16UC1);
  TIFF* tiff = TIFFOpen(path.c_str(), "wb");  // most significant byte first
  ASSERT_NE(tiff, nullptr);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, image.cols);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, image.rows);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
  constexpr int kSide = 16;
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kSide);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, kSide);
  for (int y = 0; y < image.rows; y += kSide) {
    for (int x = 0; x < image.cols; x += kSide) {
      std::array<std::uint16_t, std::size_t{kSide} * kSide> tile{};
      for (int v = 0; v < std::min(kSide, image.rows - y); ++v) {
        std::copy_n(image.ptr<std::uint16_t>(y + v) + x, std::min(kSide, image.cols - x),
                    tile.data() + std::ptrdiff_t{v} * kSide);
      }
      EXPECT_GT(TIFFWriteTile(tiff, tile.data(), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0),
                0);
    }
  }
  TIFFClose(tiff);
  const auto decoded = Tiff(Content(path));
  ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
  ExpectPixels<std::uint16_t>(*decoded, image);
}

TEST(DecodeTiff, TakesNoMemoryForTilesThatNoImageHas) {
  const testing::TempDir folder;
  const std::string path = (folder.path() / "tiles.tiff").string();
  for (const int side : {8'208, 16'384, 65'536}) {  // 0.27, 1.1 and 17 GB
    TIFF* tiff = TIFFOpen(path.c_str(), "wb");
    ASSERT_NE(tiff, nullptr);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 16);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 16);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, side);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, side);
    std::array<std::byte, 64> some{};
    EXPECT_GT(TIFFWriteRawTile(tiff, 0, some.data(), some.size()), 0);
    TIFFClose(tiff);
    const Bytes file = Content(path);
    const long before_kib = PeakMemory_kib();
    EXPECT_EQ(Tiff(file).status().reason(), Reason("BAD_IMAGE")) << side;
    EXPECT_LT(PeakMemory_kib() - before_kib, 64 << 10) << side;
  }
}

TEST(DecodeTiff, RefusesOtherKinds) {
  EXPECT_EQ(Tiff(TiffOf(Noise(CV_8UC3), kJpeg)).status().reason(), Reason("BAD_IMAGE")) << "packed with loss";
  EXPECT_EQ(Tiff({}).status().reason(), Reason("BAD_IMAGE"));
  EXPECT_EQ(Tiff(Bytes(100, 0x41)).status().reason(), Reason("BAD_IMAGE"));
  EXPECT_EQ(Tiff(Encode(Noise(CV_8UC1), ".png")).status().reason(), Reason("BAD_IMAGE"));
}

TEST(DecodeTiff, SurvivesDamageAnywhere) {
  for (const int compression : {kNone, kLzw, kDeflate}) {
    const Bytes good = TiffOf(Noise(CV_16UC1), compression);
    for (std::size_t i = 0; i<good.size(); i += i> 16 && i + 300 < good.size() ? 7 : 1) {
      Bytes bad = good;
      bad[i] ^= 0xFF;
      const auto decoded = Tiff(bad);  // may succeed: there is no checksum
      EXPECT_TRUE(decoded.ok() || decoded.status().reason() == Reason("BAD_IMAGE")) << "byte " << i;
    }
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(good.size() / 2));
    EXPECT_FALSE(Tiff(cut).ok());
  }
}

}  // namespace
}  // namespace dhpmap
