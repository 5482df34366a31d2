// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/images/png.h"

#include <spng.h>

#include <cstdlib>
#include <memory>

namespace dhpmap {
namespace {

/// Of chunks beside the pixels, such as text and colour profiles, which may unpack to any size.
constexpr std::size_t kMaxChunkBytes = 1u << 20, kMaxChunksBytes = 4u << 20;

struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

Status BadPng(int error) {
  return InvalidArgument(std::string("the PNG cannot be decoded: ") + spng_strerror(error)).WithReason("BAD_IMAGE");
}

struct PngLayout {
  int format = SPNG_FMT_PNG;  ///< samples of 16 bits in this machine's order, and all else as stored
  int num_channels = 1;
};

PngLayout PngLayoutOf(const spng_ihdr& header) {
  const bool is_deep = header.bit_depth == 16;
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE: return {is_deep ? SPNG_FMT_PNG : SPNG_FMT_G8, 1};
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA: return {is_deep ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8, 4};
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA: return {SPNG_FMT_PNG, 4};
    case SPNG_COLOR_TYPE_TRUECOLOR: return {SPNG_FMT_PNG, 3};
    default: return {SPNG_FMT_RGB8, 3};  // a palette
  }
}

}  // namespace

Result<DecodedImage> DecodePng(std::span<const std::byte> file) {
  const Context context(spng_ctx_new(0));
  if (context == nullptr) return BadPng(SPNG_EMEM);
  spng_ihdr header;
  int error = spng_set_chunk_limits(context.get(), kMaxChunkBytes, kMaxChunksBytes);
  if (error == 0) error = spng_set_png_buffer(context.get(), file.data(), file.size());
  if (error == 0) error = spng_get_ihdr(context.get(), &header);
  if (error != 0) return BadPng(error);

  const PngLayout layout = PngLayoutOf(header);
  const SampleType type = header.bit_depth == 16 ? SampleType::kUint16 : SampleType::kUint8;
  const std::size_t row_bytes =
      std::size_t{header.width} * static_cast<std::size_t>(layout.num_channels) * (header.bit_depth == 16 ? 2 : 1);
  std::size_t num_bytes = 0;
  error = spng_decoded_image_size(context.get(), layout.format, &num_bytes);
  if (error == 0 && num_bytes != row_bytes * header.height) error = SPNG_EINTERNAL;
  if (error != 0) return BadPng(error);
  std::shared_ptr<std::byte[]> pixels(new std::byte[num_bytes]);  // not set to 0 before
  error = spng_decode_image(context.get(), pixels.get(), num_bytes, layout.format, 0);
  if (error == 0) error = spng_decode_chunks(context.get());  // to the end, so that the last checksum is looked at
  if (error != 0) return BadPng(error);
  return DecodedImage{.width_px = static_cast<int>(header.width),
                      .height_px = static_cast<int>(header.height),
                      .num_channels = layout.num_channels,
                      .type = type,
                      .row_bytes = row_bytes,
                      .pixels = {pixels, pixels.get()}};
}

Result<std::string> EncodePng(std::span<const std::uint8_t> pixels, int width_px, int height_px) {
  const auto failed = [](int error) { return Internal(std::string("no PNG can be made: ") + spng_strerror(error)); };
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
  if (context == nullptr) return failed(SPNG_EMEM);
  spng_ihdr header{.width = static_cast<std::uint32_t>(width_px),
                   .height = static_cast<std::uint32_t>(height_px),
                   .bit_depth = 8,
                   .color_type = SPNG_COLOR_TYPE_GRAYSCALE,
                   .compression_method = 0,
                   .filter_method = 0,
                   .interlace_method = 0};
  int error = spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  if (error == 0) error = spng_set_ihdr(context.get(), &header);
  if (error == 0) {
    error = spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  }
  if (error != 0) return failed(error);
  std::size_t num_bytes = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(spng_get_png_buffer(context.get(), &num_bytes, &error),
                                                          &std::free);
  if (bytes == nullptr) return failed(error);
  return std::string(static_cast<const char*>(bytes.get()), num_bytes);
}

}  // namespace dhpmap
