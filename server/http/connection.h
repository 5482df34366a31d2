// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/http/message.h"
#include "server/net/peer_identity.h"

namespace dhpmap::http {

enum class ReadOutcome {
  kOk,
  kClosed,
  kTimedOut,
  kMalformed,
  kTooLarge,
  kUnknownCoding,  ///< of a head: the Transfer-Encoding is unknown, so the end of the body is, too
};

struct HeadResult {
  ReadOutcome outcome = ReadOutcome::kOk;
  std::string problem;  ///< for kMalformed
  RequestHead head;
  bool is_http_1_1 = true;
  bool keep_alive = true;
  bool has_body = false;
};

/// Receives the events of one connection on its sequence of execution; none after Connection::Close.
class ConnectionEvents {
 public:
  virtual ~ConnectionEvents() = default;
  virtual void OnHead(HeadResult head) = 0;
  /// Follows ReadBody. `data` is valid during the call; `is_end`: the body is complete.
  virtual void OnBodyData(ReadOutcome outcome, std::string_view data, bool is_end) = 0;
  virtual void OnWriteDone(bool ok) = 0;
  /// The client half-closed; it may still wait for its answer.
  virtual void OnPeerEnded() = 0;
  /// The client disconnected.
  virtual void OnPeerClosed() = 0;
};

/// One HTTP/1.1 connection: reads requests, writes bytes. At most one read and one write may be pending. Call on the
/// connection's sequence of execution only, except Post.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Keeps `events` until Close.
  virtual void Start(std::shared_ptr<ConnectionEvents> events) = 0;
  virtual void ReadHead() = 0;
  virtual void ReadBody() = 0;
  virtual void Write(std::string first, std::string second) = 0;
  /// Enables OnPeerEnded and OnPeerClosed while no read is pending. A half-closed client looks like one that is gone
  /// until something is written to it. So after a half-close, `probe` is written repeatedly until the next Write.
  virtual void WatchPeer(std::string probe) = 0;
  virtual void StopWatching() = 0;
  /// Half-closes: the client sees the end of the answer, and may still send.
  virtual void CloseSending() = 0;
  virtual void Close() = 0;
  /// The address that the client connected to, without the port: "127.0.0.1", "::1"; empty for a unix: address.
  [[nodiscard]] virtual std::string local_address() const = 0;
  /// The client's identity, as far as the connection proves it.
  [[nodiscard]] virtual net::PeerIdentity peer() const { return {}; }
  virtual void Post(std::function<void()> task) = 0;
};

}  // namespace dhpmap::http
