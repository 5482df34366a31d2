// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/image_header.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace dhpmap {
namespace {

using Bytes = std::span<const std::byte>;

Status BadImageFile(std::string_view what) { return InvalidArgument(std::string(what)).WithReason("BAD_IMAGE"); }

bool StartsWith(Bytes file, std::string_view magic) {
  return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
}

/// Integers at byte positions; positions past the end read as 0 and set `is_short`.
struct Reader {
  Bytes file;
  bool is_big_endian = true;
  bool is_short = false;
  bool is_strange = false;  ///< a TIFF's field is of a type in which nobody writes it, though libtiff would read it

  std::uint64_t Read(std::uint64_t position, int num_bytes) {
    if (position > file.size() || file.size() - position < static_cast<std::uint64_t>(num_bytes)) {
      is_short = true;
      return 0;
    }
    std::uint64_t value = 0;
    for (int i = 0; i < num_bytes; ++i) {
      const int place = is_big_endian ? num_bytes - 1 - i : i;
      value |= std::to_integer<std::uint64_t>(file[position + static_cast<std::uint64_t>(i)]) << (8 * place);
    }
    return value;
  }
};

std::int64_t DecodedBytes(std::int64_t width, std::int64_t height, std::int64_t bytes_per_pixel) {
  constexpr std::int64_t kBeyondAll = std::numeric_limits<std::int64_t>::max();
  std::int64_t bytes = 0;
  const bool overflows =
      __builtin_mul_overflow(width, height, &bytes) || __builtin_mul_overflow(bytes, bytes_per_pixel, &bytes);
  return overflows ? kBeyondAll : bytes;
}

std::int64_t PngBytesPerPixel(std::uint64_t bit_depth, std::uint64_t color_type) {
  const std::int64_t channels = color_type == 0 ? 1 : 4;  // at most: colours and palettes may have alpha
  return channels * (bit_depth == 16 ? 2 : 1);
}

// PNG (ISO/IEC 15948): after the signature, chunks of length, type, data, checksum; IHDR first, IEND last.
Result<ImageHeader> ReadPng(Bytes file) {
  constexpr std::uint64_t kIhdr = 0x49484452, kIend = 0x49454E44;
  Reader in{file};
  ImageHeader header{.kind = ImageKind::kPng};
  std::uint64_t position = 8;
  if (in.Read(position + 4, 4) != kIhdr) return BadImageFile("the PNG file has no header");
  header.width_px = static_cast<std::int64_t>(in.Read(position + 8, 4));
  header.height_px = static_cast<std::int64_t>(in.Read(position + 12, 4));
  header.decoded_bytes = DecodedBytes(header.width_px, header.height_px,
                                      PngBytesPerPixel(in.Read(position + 16, 1), in.Read(position + 17, 1)));
  while (!in.is_short) {
    const std::uint64_t length = in.Read(position, 4);
    const std::uint64_t type = in.Read(position + 4, 4);
    position += 12 + length;
    if (position > file.size()) break;
    if (type == kIend) return header;
  }
  return BadImageFile("the PNG file is truncated");
}

bool IsFrameMarker(std::uint64_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// First position from `position` on that holds 0xFF and then a marker other than a stuffed zero, fill, or one that
/// stands alone (a restart, TEM).
std::uint64_t FindMarker(Bytes file, std::uint64_t position) {
  while (position < file.size()) {
    const void* found = std::memchr(file.data() + position, 0xFF, file.size() - position);
    if (found == nullptr) break;
    position = static_cast<std::uint64_t>(static_cast<const std::byte*>(found) - file.data());
    const auto next = position + 1 < file.size() ? std::to_integer<int>(file[position + 1]) : 0;
    if (next != 0x00 && next != 0x01 && next != 0xFF && !(next >= 0xD0 && next <= 0xD7)) return position;
    ++position;
  }
  return file.size();
}

// JPEG (ITU-T T.81, annex B): marker segments; the coded data after each SOS runs up to the next marker.
Result<ImageHeader> ReadJpeg(Bytes file) {
  constexpr std::uint64_t kProgressive = 0xC2, kEoi = 0xD9, kSos = 0xDA;
  Reader in{file};
  ImageHeader header{.kind = ImageKind::kJpeg};
  bool has_frame = false, is_progressive = false;
  int num_scans = 0;
  std::uint64_t position = 2;
  while (true) {
    position = FindMarker(file, position);
    const std::uint64_t marker = in.Read(position + 1, 1);
    if (marker == kEoi) break;
    const std::uint64_t length = in.Read(position + 2, 2);
    if (IsFrameMarker(marker)) {
      // The decoder takes the first, whatever a later one says.
      if (std::exchange(has_frame, true)) return BadImageFile("the JPEG file has more than one frame header");
      is_progressive = marker == kProgressive;
      header.height_px = static_cast<std::int64_t>(in.Read(position + 5, 2));
      header.width_px = static_cast<std::int64_t>(in.Read(position + 7, 2));
      header.decoded_bytes =
          DecodedBytes(header.width_px, header.height_px, static_cast<std::int64_t>(in.Read(position + 9, 1)));
    }
    num_scans += marker == kSos;
    if (in.is_short) return BadImageFile("the JPEG file is truncated");
    position += 2 + length;
  }
  if (num_scans == 0) return BadImageFile("the JPEG file holds no image");
  // Until the last scan is read the decoder keeps a coefficient of two bytes for each value.
  if (is_progressive || num_scans > 1) header.decoded_bytes *= 3;
  return header;
}

/// One entry of a TIFF directory: values of 2 (SHORT) or 4 (LONG) bytes, in the entry itself if they fit into 4 bytes.
struct TiffField {
  std::uint64_t count = 0;
  int value_bytes = 0;
  std::uint64_t position = 0;

  std::uint64_t Value(Reader& in, std::uint64_t i) const {
    return in.Read(position + i * static_cast<std::uint64_t>(value_bytes), value_bytes);
  }
};

std::optional<TiffField> FindTiffField(Reader& in, std::uint64_t directory, std::uint64_t tag) {
  const std::uint64_t num_entries = in.Read(directory, 2);
  for (std::uint64_t i = 0; i < num_entries && !in.is_short; ++i) {
    const std::uint64_t entry = directory + 2 + 12 * i;
    if (in.Read(entry, 2) != tag) continue;
    const std::uint64_t type = in.Read(entry + 2, 2);
    if (type != 3 && type != 4) {
      in.is_strange = true;
      return std::nullopt;
    }
    TiffField field{.count = in.Read(entry + 4, 4), .value_bytes = type == 3 ? 2 : 4, .position = entry + 8};
    if (field.count * static_cast<std::uint64_t>(field.value_bytes) > 4) field.position = in.Read(entry + 8, 4);
    return field;
  }
  return std::nullopt;
}

/// Samples a pixel (1 if it is not said), each as wide as the widest; at least the four bytes of the RGBA buffer that
/// libtiff may go through.
std::int64_t TiffBytesPerPixel(Reader& in, std::uint64_t directory) {
  constexpr std::uint64_t kMostSamples = 64;
  const auto bits = FindTiffField(in, directory, 258);
  const auto samples = FindTiffField(in, directory, 277);
  const std::uint64_t num_samples = samples ? samples->Value(in, 0) : 1;
  std::uint64_t most_bits = 8;
  for (std::uint64_t i = 0; bits && i < std::min(bits->count, kMostSamples); ++i) {
    most_bits = std::max(most_bits, bits->Value(in, i));
  }
  return static_cast<std::int64_t>(std::max<std::uint64_t>(num_samples * ((most_bits + 7) / 8), 4));
}

// TIFF 6.0: a directory of fields, among them where the strips (or tiles) of the first image lie.
Result<ImageHeader> ReadTiff(Bytes file, bool is_big_endian) {
  Reader in{.file = file, .is_big_endian = is_big_endian};
  const std::uint64_t directory = in.Read(4, 4);
  const auto width = FindTiffField(in, directory, 256);
  const auto height = FindTiffField(in, directory, 257);
  auto offsets = FindTiffField(in, directory, 273);
  auto lengths = FindTiffField(in, directory, 279);
  if (!offsets || !lengths) {
    offsets = FindTiffField(in, directory, 324);
    lengths = FindTiffField(in, directory, 325);
  }
  if (in.is_short) return BadImageFile("the TIFF file is truncated");
  if (!width || !height || !offsets || !lengths || offsets->count != lengths->count) {
    return BadImageFile("the TIFF file has no complete directory");
  }
  for (std::uint64_t i = 0; i < offsets->count; ++i) {
    const std::uint64_t end = offsets->Value(in, i) + lengths->Value(in, i);
    if (in.is_short || end > file.size()) return BadImageFile("the TIFF file is truncated");
  }
  ImageHeader header{.kind = ImageKind::kTiff,
                     .width_px = static_cast<std::int64_t>(width->Value(in, 0)),
                     .height_px = static_cast<std::int64_t>(height->Value(in, 0))};
  const std::int64_t bytes_per_pixel = TiffBytesPerPixel(in, directory);
  const auto tile_width = FindTiffField(in, directory, 322);
  const auto tile_height = FindTiffField(in, directory, 323);
  header.decoded_bytes = DecodedBytes(header.width_px, header.height_px, bytes_per_pixel);
  if (tile_width && tile_height) {
    const auto width_of_tile = static_cast<std::int64_t>(tile_width->Value(in, 0));
    const auto height_of_tile = static_cast<std::int64_t>(tile_height->Value(in, 0));
    header.decoded_bytes = std::max(header.decoded_bytes, DecodedBytes(width_of_tile, height_of_tile, bytes_per_pixel));
  }
  if (in.is_short) return BadImageFile("the TIFF file is truncated");
  if (in.is_strange) return BadImageFile("the TIFF file's directory has sizes that are neither SHORT nor LONG");
  return header;
}

}  // namespace

Result<ImageHeader> ReadImageHeader(Bytes file) {
  using namespace std::string_view_literals;
  if (file.empty()) return BadImageFile("the image file is empty");
  if (StartsWith(file, "\x89PNG\r\n\x1a\n"sv)) return ReadPng(file);
  if (StartsWith(file, "\xff\xd8"sv)) return ReadJpeg(file);
  if (StartsWith(file, "II*\0"sv)) return ReadTiff(file, false);
  if (StartsWith(file, "MM\0*"sv)) return ReadTiff(file, true);
  return BadImageFile("the image file is neither PNG, JPEG nor TIFF, or is cut off before it says so");
}

}  // namespace dhpmap
