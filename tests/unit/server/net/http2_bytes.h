// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/net/frame_reader.h"

namespace dhpmap::testing {

inline std::string BigEndianBytes(std::uint32_t value, int num_bytes) {
  std::string bytes;
  for (int i = num_bytes - 1; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  return bytes;
}

/// The head of a frame (RFC 9113, 4.1), which may promise more than comes.
inline std::string FrameHeadBytes(std::size_t length_bytes, net::FrameType type, int flags, std::uint32_t stream) {
  std::string head = BigEndianBytes(static_cast<std::uint32_t>(length_bytes), 3);
  head += static_cast<char>(type);
  head += static_cast<char>(flags);
  head += BigEndianBytes(stream, 4);
  return head;
}

inline std::string FrameBytes(net::FrameType type, int flags, std::uint32_t stream, std::string_view payload = {}) {
  std::string frame = FrameHeadBytes(payload.size(), type, flags, stream);
  frame += payload;
  return frame;
}

/// A field of HPACK (RFC 7541, 6.2.2): a literal that is not indexed, with a new name; both below 127 bytes.
inline std::string LiteralField(std::string_view name, std::string_view value) {
  std::string field(1, '\0');
  field += static_cast<char>(name.size());
  field += name;
  field += static_cast<char>(value.size());
  field += value;
  return field;
}

/// The fields of a gRPC call.
inline std::string CallFields(std::string_view path) {
  return LiteralField(":method", "POST") + LiteralField(":scheme", "http") + LiteralField(":path", path) +
         LiteralField(":authority", "localhost") + LiteralField("te", "trailers") +
         LiteralField("content-type", "application/grpc");
}

}  // namespace dhpmap::testing
