// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace dhpmap {

enum class SampleType { kUint8, kInt8, kUint16, kInt16, kInt32, kFloat, kDouble, kHalf };
std::string ToString(SampleType type);

/// An image as its file has it: no change of depth or orientation. Grey has one channel, colour three, red first, with
/// alpha four.
struct DecodedImage {
  int width_px = 0, height_px = 0, num_channels = 0;
  SampleType type = SampleType::kUint8;
  std::size_t row_bytes = 0;
  std::shared_ptr<const void> pixels;  ///< row by row

  template <typename Sample>
  [[nodiscard]] const Sample* Row(int v) const {
    return reinterpret_cast<const Sample*>(static_cast<const std::byte*>(pixels.get()) +
                                           static_cast<std::size_t>(v) * row_bytes);
  }
};

}  // namespace dhpmap
