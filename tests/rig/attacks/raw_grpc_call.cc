// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/raw_grpc_call.h"

#include <algorithm>
#include <utility>

namespace dhpmap::rig {
namespace {

// RFC 9113, section 6.
enum FrameType { kData = 0, kHeaders = 1, kReset = 3, kSettings = 4, kPing = 6, kGoAway = 7, kWindowUpdate = 8 };
constexpr int kAck = 1, kEndStream = 1, kEndHeaders = 4;
constexpr std::uint32_t kInitialWindowSize = 4;  // of the settings
constexpr std::size_t kFrameHead_bytes = 9, kMostPayload_bytes = 16384;
constexpr std::int64_t kDefaultWindow_bytes = 65535;
constexpr std::uint32_t kConnection = 0, kCall = 1;

std::string BigEndian(std::uint32_t value, int num_bytes) {
  std::string bytes;
  for (int i = num_bytes - 1; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  return bytes;
}

std::uint32_t FromBigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

std::string FrameOf(FrameType type, int flags, std::uint32_t stream, std::string_view payload) {
  std::string frame = BigEndian(static_cast<std::uint32_t>(payload.size()), 3);
  frame += static_cast<char>(type);
  frame += static_cast<char>(flags);
  frame += BigEndian(stream, 4);
  return frame.append(payload);
}

/// A header of HPACK (RFC 7541, 6.2.2): a literal that is not indexed, with a new name; both below 127 bytes.
std::string Literal(std::string_view name, std::string_view value) {
  std::string header(1, '\0');
  header += static_cast<char>(name.size());
  header += name;
  header += static_cast<char>(value.size());
  header += value;
  return header;
}

}  // namespace

RawGrpcCall::RawGrpcCall(int port, std::string_view method)
    : socket_(port),
      connection_window_bytes_(kDefaultWindow_bytes),
      call_window_bytes_(kDefaultWindow_bytes),
      initial_window_bytes_(kDefaultWindow_bytes) {
  const std::string headers = Literal(":method", "POST") + Literal(":scheme", "http") + Literal(":path", method) +
                              Literal(":authority", "localhost") + Literal("te", "trailers") +
                              Literal("content-type", "application/grpc");
  is_over_ = !socket_.SendRaw("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + FrameOf(kSettings, 0, kConnection, "") +
                              FrameOf(kHeaders, kEndHeaders, kCall, headers));
}

bool RawGrpcCall::BeginMessage(std::uint32_t num_bytes) {
  return SendData(std::string(1, '\0') + BigEndian(num_bytes, 4));  // not compressed
}

bool RawGrpcCall::Send(std::size_t num_bytes) { return SendData(std::string(num_bytes, '\0')); }

bool RawGrpcCall::SendData(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::int64_t window_bytes = std::min(connection_window_bytes_, call_window_bytes_);
    if (window_bytes <= 0) {
      if (!Listen()) return false;
      continue;
    }
    const std::string_view part = bytes.substr(0, std::min(kMostPayload_bytes, static_cast<std::size_t>(window_bytes)));
    if (is_over_ || !socket_.SendRaw(FrameOf(kData, 0, kCall, part))) return false;
    connection_window_bytes_ -= static_cast<std::int64_t>(part.size());
    call_window_bytes_ -= static_cast<std::int64_t>(part.size());
    bytes.remove_prefix(part.size());
  }
  return true;
}

bool RawGrpcCall::Listen() {
  const std::string more = socket_.ReadSome();
  if (more.empty()) is_over_ = true;
  arrived_ += more;
  while (arrived_.size() >= kFrameHead_bytes) {
    const std::string_view head(arrived_.data(), kFrameHead_bytes);
    const std::size_t payload_bytes = FromBigEndian(head.substr(0, 3));
    if (arrived_.size() < kFrameHead_bytes + payload_bytes) break;
    const std::string payload = arrived_.substr(kFrameHead_bytes, payload_bytes);
    OnFrame(static_cast<unsigned char>(head[3]), static_cast<unsigned char>(head[4]), FromBigEndian(head.substr(5, 4)),
            payload);
    arrived_.erase(0, kFrameHead_bytes + payload_bytes);
  }
  return !is_over_;
}

void RawGrpcCall::OnFrame(int type, int flags, std::uint32_t stream, std::string_view payload) {
  const bool is_ack = (flags & kAck) != 0;
  if (type == kSettings && !is_ack) OnSettings(payload);
  if (type == kPing && !is_ack) (void)socket_.SendRaw(FrameOf(kPing, kAck, kConnection, payload));
  if (type == kWindowUpdate) {
    (stream == kConnection ? connection_window_bytes_ : call_window_bytes_) += FromBigEndian(payload.substr(0, 4));
  }
  if (type == kReset || type == kGoAway || (type == kHeaders && (flags & kEndStream) != 0)) is_over_ = true;
}

/// A window that begins larger is larger from now on, by as much (RFC 9113, 6.9.2).
void RawGrpcCall::OnSettings(std::string_view payload) {
  constexpr std::size_t kSetting_bytes = 6;
  for (; payload.size() >= kSetting_bytes; payload.remove_prefix(kSetting_bytes)) {
    if (FromBigEndian(payload.substr(0, 2)) != kInitialWindowSize) continue;
    const std::int64_t initial_bytes = FromBigEndian(payload.substr(2, 4));
    call_window_bytes_ += initial_bytes - std::exchange(initial_window_bytes_, initial_bytes);
  }
  (void)socket_.SendRaw(FrameOf(kSettings, kAck, kConnection, ""));
}

}  // namespace dhpmap::rig
