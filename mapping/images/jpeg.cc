// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/images/jpeg.h"

#include <turbojpeg.h>

#include <memory>
#include <string>
#include <type_traits>

namespace dhpmap {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};

Status BadJpeg(const std::string& what) {
  return InvalidArgument("the JPEG cannot be decoded: " + what).WithReason("BAD_IMAGE");
}

}  // namespace

Result<DecodedImage> DecodeJpeg(std::span<const std::byte> file) {
  const std::unique_ptr<std::remove_pointer_t<tjhandle>, Destroy> handle(tjInitDecompress());
  if (handle == nullptr) return BadJpeg(tjGetErrorStr2(nullptr));
  const auto* bytes = reinterpret_cast<const unsigned char*>(file.data());
  int width_px = 0, height_px = 0, subsampling = 0, colors = 0;
  if (tjDecompressHeader3(handle.get(), bytes, file.size(), &width_px, &height_px, &subsampling, &colors) != 0) {
    return BadJpeg(tjGetErrorStr2(handle.get()));
  }
  if (colors == TJCS_CMYK || colors == TJCS_YCCK) return BadJpeg("its colours are those of print (CMYK)");
  const bool is_grey = colors == TJCS_GRAY;
  const std::size_t row_bytes = static_cast<std::size_t>(width_px) * (is_grey ? 1 : 3);
  const std::size_t num_bytes = row_bytes * static_cast<std::size_t>(height_px);
  std::shared_ptr<std::byte[]> pixels(new std::byte[num_bytes]);
  const int outcome =
      tjDecompress2(handle.get(), bytes, file.size(), reinterpret_cast<unsigned char*>(pixels.get()), width_px,
                    static_cast<int>(row_bytes), height_px, is_grey ? TJPF_GRAY : TJPF_RGB, TJFLAG_LIMITSCANS);
  if (outcome != 0 && tjGetErrorCode(handle.get()) != TJERR_WARNING) return BadJpeg(tjGetErrorStr2(handle.get()));
  return DecodedImage{.width_px = width_px,
                      .height_px = height_px,
                      .num_channels = is_grey ? 1 : 3,
                      .type = SampleType::kUint8,
                      .row_bytes = row_bytes,
                      .pixels = {pixels, pixels.get()}};
}

}  // namespace dhpmap
