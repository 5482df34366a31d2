// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/camera_file.h"

#include <array>
#include <cmath>
#include <cstring>

#include "clients/datasets/file_reader.h"

namespace dhpmap {
namespace {

int BigEndian32(const std::byte* bytes) {
  return std::to_integer<int>(bytes[0]) << 24 | std::to_integer<int>(bytes[1]) << 16 |
         std::to_integer<int>(bytes[2]) << 8 | std::to_integer<int>(bytes[3]);
}

}  // namespace

Result<std::optional<PinholeCamera>> FindCameraFile(std::span<const std::filesystem::path> folders) {
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path path = folder / "camera.txt";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) continue;
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<double> numbers, ReadNumbers(path));
    if (numbers.size() != 6) return BadFile(path, "must hold 6 numbers: width height fx fy cx cy");
    for (double size : {numbers[0], numbers[1]}) {
      if (!(size >= 1 && size <= 16384 && size == std::floor(size))) {
        return BadFile(path, "width and height must be whole numbers from 1 to 16384");
      }
    }
    const PinholeCamera camera{.width_px = static_cast<int>(numbers[0]),
                               .height_px = static_cast<int>(numbers[1]),
                               .fx_px = numbers[2],
                               .fy_px = numbers[3],
                               .cx_px = numbers[4],
                               .cy_px = numbers[5]};
    if (const Status status = camera.Validate(); !status.ok()) return BadFile(path, status.message());
    return std::optional(camera);
  }
  return std::optional<PinholeCamera>();
}

Result<std::pair<int, int>> PngSize(std::span<const std::byte> file) {
  constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::size_t kHeaderBytes = 24;  // signature, chunk length and name, width, height
  if (file.size() < kHeaderBytes || std::memcmp(file.data(), kSignature.data(), kSignature.size()) != 0) {
    return InvalidArgument("not a PNG file").WithReason("BAD_IMAGE");
  }
  return std::pair(BigEndian32(file.data() + 16), BigEndian32(file.data() + 20));
}

}  // namespace dhpmap
