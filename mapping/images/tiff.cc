// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/images/tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dhpmap {
namespace {

constexpr tmsize_t kMaxAllocation = 1 << 28;  // as much as an image may take in all

Status BadTiff(const std::string& what) {
  return InvalidArgument("the TIFF cannot be decoded: " + what).WithReason("BAD_IMAGE");
}

/// A file in memory, as libtiff reads one, and what it has to say of it.
struct Source {
  std::span<const std::byte> file;
  std::size_t at = 0;
  std::string problem;  ///< the first
};

Source& SourceOf(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t Read(thandle_t handle, void* to, tmsize_t num_bytes) {
  Source& source = SourceOf(handle);
  const std::size_t left = source.at < source.file.size() ? source.file.size() - source.at : 0;
  const std::size_t num_read = std::min(left, static_cast<std::size_t>(num_bytes));
  if (num_read > 0) std::memcpy(to, source.file.data() + source.at, num_read);
  source.at += num_read;
  return static_cast<tmsize_t>(num_read);
}

tmsize_t Write(thandle_t, void*, tmsize_t) { return 0; }

toff_t Seek(thandle_t handle, toff_t offset, int whence) {
  Source& source = SourceOf(handle);
  if (whence == SEEK_CUR) offset += source.at;
  if (whence == SEEK_END) offset += source.file.size();
  source.at = offset;
  return offset;
}

int Close(thandle_t) { return 0; }
toff_t Size(thandle_t handle) { return SourceOf(handle).file.size(); }

int NoteProblem(TIFF*, void* handle, const char*, const char* format, va_list arguments) {
  std::string& problem = SourceOf(handle).problem;
  char text[200];
  std::vsnprintf(text, sizeof text, format, arguments);
  if (problem.empty()) problem = text;
  return 1;
}

int IgnoreWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct FreeTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};
using Tiff = std::unique_ptr<TIFF, FreeTiff>;

Tiff Open(Source& source) {
  const std::unique_ptr<TIFFOpenOptions, FreeTiff> options(TIFFOpenOptionsAlloc());
  if (options == nullptr) return nullptr;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxAllocation);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), NoteProblem, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), IgnoreWarning, nullptr);
  // 'm': not mapped, for it is in memory; 'c': strips as they are, not cut into smaller ones.
  return Tiff(
      TIFFClientOpenExt("image", "rmc", &source, Read, Write, Seek, Close, Size, nullptr, nullptr, options.get()));
}

struct TiffLayout {
  std::uint32_t width_px = 0, height_px = 0;
  std::uint16_t bits = 1, num_channels = 1, format = SAMPLEFORMAT_UINT, planes = PLANARCONFIG_CONTIG;
  std::uint16_t meaning = PHOTOMETRIC_MINISBLACK, compression = COMPRESSION_NONE;
};

TiffLayout TiffLayoutOf(TIFF* tiff) {
  TiffLayout layout;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width_px);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height_px);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &layout.num_channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &layout.format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &layout.planes);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &layout.meaning);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &layout.compression);
  return layout;
}

std::optional<SampleType> TypeOf(const TiffLayout& layout) {
  const bool is_signed = layout.format == SAMPLEFORMAT_INT;
  if (layout.format == SAMPLEFORMAT_IEEEFP) {
    if (layout.bits == 16) return SampleType::kHalf;
    if (layout.bits == 32) return SampleType::kFloat;
    if (layout.bits == 64) return SampleType::kDouble;
    return std::nullopt;
  }
  if (!is_signed && layout.format != SAMPLEFORMAT_UINT) return std::nullopt;
  if (layout.bits == 8) return is_signed ? SampleType::kInt8 : SampleType::kUint8;
  if (layout.bits == 16) return is_signed ? SampleType::kInt16 : SampleType::kUint16;
  if (layout.bits == 32 && is_signed) return SampleType::kInt32;
  return std::nullopt;
}

/// What of it we do not read; empty if we do.
std::string WhyNot(const TiffLayout& layout) {
  switch (layout.compression) {
    case COMPRESSION_NONE:
    case COMPRESSION_LZW:
    case COMPRESSION_ADOBE_DEFLATE:
    case COMPRESSION_DEFLATE:
    case COMPRESSION_PACKBITS: break;
    default: return "it is packed by a way (" + std::to_string(layout.compression) + ") that is not read";
  }
  const bool is_grey = layout.meaning == PHOTOMETRIC_MINISBLACK && layout.num_channels == 1;
  const bool is_color = layout.meaning == PHOTOMETRIC_RGB && (layout.num_channels == 3 || layout.num_channels == 4);
  if (!is_grey && !is_color) return "it is neither grey nor of red, green and blue";
  if (is_color && layout.planes != PLANARCONFIG_CONTIG) return "its colours are stored apart";
  return {};
}

bool ReadStrips(TIFF* tiff, std::byte* pixels, std::size_t num_bytes) {
  const auto strip_bytes = static_cast<std::size_t>(TIFFStripSize(tiff));
  std::size_t at = 0;
  for (std::uint32_t strip = 0; strip < TIFFNumberOfStrips(tiff) && at < num_bytes; ++strip) {
    const std::size_t wanted = std::min(strip_bytes, num_bytes - at);
    const tmsize_t num_read = TIFFReadEncodedStrip(tiff, strip, pixels + at, static_cast<tmsize_t>(wanted));
    if (num_read != static_cast<tmsize_t>(wanted)) return false;
    at += wanted;
  }
  return at == num_bytes;
}

bool ReadTiles(TIFF* tiff, const TiffLayout& layout, std::size_t row_bytes, std::byte* pixels) {
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  const auto tile_row_bytes = static_cast<std::size_t>(TIFFTileRowSize(tiff));
  const auto tile_bytes = static_cast<std::size_t>(TIFFTileSize(tiff));  // 0 if there is no such number
  if (width == 0 || height == 0 || tile_bytes == 0 || tile_row_bytes != tile_bytes / height ||
      tile_bytes > static_cast<std::size_t>(kMaxAllocation)) {
    return false;
  }
  std::vector<std::byte> tile(tile_bytes);
  for (std::uint32_t y = 0; y < layout.height_px; y += std::min(height, layout.height_px - y)) {
    for (std::uint32_t x = 0; x < layout.width_px; x += std::min(width, layout.width_px - x)) {
      const auto num_bytes = static_cast<tmsize_t>(tile.size());
      const std::uint32_t number = TIFFComputeTile(tiff, x, y, 0, 0);
      if (TIFFReadEncodedTile(tiff, number, tile.data(), num_bytes) != num_bytes) return false;
      const std::size_t from_x = x / width * tile_row_bytes;
      const std::size_t count = std::min(tile_row_bytes, row_bytes - from_x);
      for (std::uint32_t v = 0; v < std::min(height, layout.height_px - y); ++v) {
        std::memcpy(pixels + (y + v) * row_bytes + from_x, tile.data() + v * tile_row_bytes, count);
      }
    }
  }
  return true;
}

}  // namespace

Result<DecodedImage> DecodeTiff(std::span<const std::byte> file) {
  Source source{.file = file};
  const Tiff tiff = Open(source);
  if (tiff == nullptr) return BadTiff(source.problem.empty() ? "there is no memory for it" : source.problem);
  const TiffLayout layout = TiffLayoutOf(tiff.get());
  const std::optional<SampleType> type = TypeOf(layout);
  if (!type) return BadTiff("its samples of " + std::to_string(layout.bits) + " bits are of no type that is read");
  if (std::string why = WhyNot(layout); !why.empty()) return BadTiff(why);

  const std::size_t row_bytes = std::size_t{layout.width_px} * layout.num_channels * layout.bits / 8;
  const std::size_t num_bytes = row_bytes * layout.height_px;
  if (num_bytes == 0 || num_bytes > static_cast<std::size_t>(kMaxAllocation)) return BadTiff("of its size");
  const std::shared_ptr<std::byte[]> pixels(new std::byte[num_bytes]);
  const bool is_read = TIFFIsTiled(tiff.get()) != 0 ? ReadTiles(tiff.get(), layout, row_bytes, pixels.get())
                                                    : ReadStrips(tiff.get(), pixels.get(), num_bytes);
  if (!is_read) {
    return BadTiff(source.problem.empty() ? "it ends before its pixels do, or its tiles are too large"
                                          : source.problem);
  }
  return DecodedImage{.width_px = static_cast<int>(layout.width_px),
                      .height_px = static_cast<int>(layout.height_px),
                      .num_channels = layout.num_channels,
                      .type = *type,
                      .row_bytes = row_bytes,
                      .pixels = {pixels, pixels.get()}};
}

}  // namespace dhpmap
