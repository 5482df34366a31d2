// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "server/net/refusal.h"

namespace dhpmap::net {

/// The client's connection preface, before its first frame (RFC 9113, 3.4).
inline constexpr std::string_view kHttp2Preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// RFC 9113, section 6.
enum class FrameType : std::uint8_t {
  kData = 0,
  kHeaders = 1,
  kPriority = 2,
  kReset = 3,
  kSettings = 4,
  kPushPromise = 5,
  kPing = 6,
  kGoAway = 7,
  kWindowUpdate = 8,
  kContinuation = 9,
};
namespace frame_flags {
constexpr std::uint8_t kAck = 0x1, kEndStream = 0x1, kEndHeaders = 0x4, kPadded = 0x8, kPriority = 0x20;
}

struct FrameHead {
  std::uint32_t length_bytes = 0;
  FrameType type = FrameType::kData;  ///< may be an unknown type
  std::uint8_t flags = 0;
  std::uint32_t stream = 0;

  [[nodiscard]] bool Has(std::uint8_t flag) const { return (flags & flag) != 0; }
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual Refusal OnHead(const FrameHead& head) = 0;
  /// A part of the payload as it arrives; not for DATA. `is_end` with the last part, or at once for an empty payload.
  virtual Refusal OnPayload(std::string_view part, bool is_end) = 0;
};

/// Parses the frames of one direction of an HTTP/2 connection after the preface, from pieces of any size. Keeps nine
/// bytes. Thread-compatible.
class FrameReader {
 public:
  /// Stops at the first refusal; must not be called again after it.
  Refusal Read(std::string_view bytes, FrameSink& sink);
  /// Whether the data so far end at a frame boundary.
  [[nodiscard]] bool is_between_frames() const { return num_head_bytes_ == 0 && payload_left_bytes_ == 0; }

 private:
  static constexpr std::size_t kHead_bytes = 9;

  std::array<std::uint8_t, kHead_bytes> head_{};
  std::size_t num_head_bytes_ = 0;
  std::size_t payload_left_bytes_ = 0;
  bool is_data_ = false;
};

}  // namespace dhpmap::net
