// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {

/// One gRPC call on a connection of its own, written byte by byte, so that it can be left in the middle of a message.
/// Keeps to HTTP/2 (RFC 9113), flow control included: a server has no reason to hang up on it. Thread-compatible.
class RawGrpcCall {
 public:
  /// Begins the call on 127.0.0.1. `method`: "/dhpmap.v1.MappingService/IntegrateFrames".
  RawGrpcCall(int port, std::string_view method);

  /// Announces a message of so many bytes.
  bool BeginMessage(std::uint32_t num_bytes);
  /// Sends so many bytes of it, as the server makes room for them. False if it has ended the call, or makes none for
  /// 10 s.
  bool Send(std::size_t num_bytes);

 private:
  bool SendData(std::string_view bytes);
  /// Waits for what the server says of the connection and the call.
  bool Listen();
  void OnFrame(int type, int flags, std::uint32_t stream, std::string_view payload);
  void OnSettings(std::string_view payload);

  http::HttpClient socket_;
  std::string arrived_;
  std::int64_t connection_window_bytes_, call_window_bytes_, initial_window_bytes_;
  bool is_over_ = false;
};

}  // namespace dhpmap::rig
