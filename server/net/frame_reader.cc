// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/frame_reader.h"

#include <algorithm>

namespace dhpmap::net {
namespace {

FrameHead HeadOf(const std::array<std::uint8_t, 9>& b) {
  return {.length_bytes = static_cast<std::uint32_t>(b[0] << 16 | b[1] << 8 | b[2]),
          .type = static_cast<FrameType>(b[3]),
          .flags = b[4],
          .stream = (b[5] & 0x7Fu) << 24 | static_cast<std::uint32_t>(b[6] << 16 | b[7] << 8 | b[8])};
}

}  // namespace

Refusal FrameReader::Read(std::string_view bytes, FrameSink& sink) {
  while (!bytes.empty()) {
    if (payload_left_bytes_ > 0) {
      const std::string_view part = bytes.substr(0, payload_left_bytes_);
      bytes.remove_prefix(part.size());
      payload_left_bytes_ -= part.size();
      if (is_data_) continue;
      const Refusal refusal = sink.OnPayload(part, payload_left_bytes_ == 0);
      if (refusal != Refusal::kNone) return refusal;
      continue;
    }
    const std::size_t step = std::min(bytes.size(), kHead_bytes - num_head_bytes_);
    std::copy_n(bytes.begin(), step, head_.begin() + static_cast<std::ptrdiff_t>(num_head_bytes_));
    bytes.remove_prefix(step);
    num_head_bytes_ += step;
    if (num_head_bytes_ < kHead_bytes) break;
    num_head_bytes_ = 0;
    const FrameHead head = HeadOf(head_);
    is_data_ = head.type == FrameType::kData;
    payload_left_bytes_ = head.length_bytes;
    Refusal refusal = sink.OnHead(head);
    if (refusal == Refusal::kNone && !is_data_ && head.length_bytes == 0) refusal = sink.OnPayload({}, true);
    if (refusal != Refusal::kNone) return refusal;
  }
  return Refusal::kNone;
}

}  // namespace dhpmap::net
