// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "server/net/refusal.h"

namespace dhpmap::net {

/// What a client says before its first frame (RFC 9113, 3.4).
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
  FrameType type = FrameType::kData;  ///< may be none of those above
  std::uint8_t flags = 0;
  std::uint32_t stream = 0;

  [[nodiscard]] bool Has(std::uint8_t flag) const { return (flags & flag) != 0; }
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual Refusal OnHead(const FrameHead& head) = 0;
  /// A part of the payload, as it came; not of DATA. After the last part, or at once where there is none, `is_end`.
  virtual Refusal OnPayload(std::string_view part, bool is_end) = 0;
};

/// Finds the frames in what one side of an HTTP/2 connection sends after its preface, whatever pieces it comes in.
/// Keeps nine bytes. Thread-compatible.
class FrameReader {
 public:
  /// Stops at the first refusal, and must not be asked again.
  Refusal Read(std::string_view bytes, FrameSink& sink);
  /// Whether what was read ends where a frame does.
  [[nodiscard]] bool is_between_frames() const { return num_head_bytes_ == 0 && payload_left_bytes_ == 0; }

 private:
  static constexpr std::size_t kHead_bytes = 9;

  std::array<std::uint8_t, kHead_bytes> head_{};
  std::size_t num_head_bytes_ = 0;
  std::size_t payload_left_bytes_ = 0;
  bool is_data_ = false;
};

}  // namespace dhpmap::net
