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
  kUnknownCoding,  ///< of a head: the body's Transfer-Encoding is none that we know, so its end is not known either
};

struct HeadResult {
  ReadOutcome outcome = ReadOutcome::kOk;
  std::string problem;  ///< of kMalformed
  RequestHead head;
  bool is_http_1_1 = true;
  bool keep_alive = true;
  bool has_body = false;
};

/// Hears of one connection, on its own sequence of execution; nothing after Connection::Close.
class ConnectionEvents {
 public:
  virtual ~ConnectionEvents() = default;
  virtual void OnHead(HeadResult head) = 0;
  /// Answers ReadBody. `data` is valid during the call; `is_end`: that was all of the body.
  virtual void OnBodyData(ReadOutcome outcome, std::string_view data, bool is_end) = 0;
  virtual void OnWriteDone(bool ok) = 0;
  /// The client sends nothing any more; it may still be waiting for its answer.
  virtual void OnPeerEnded() = 0;
  /// The client is gone.
  virtual void OnPeerClosed() = 0;
};

/// One connection that speaks HTTP/1.1: reads requests, writes bytes. One read and one write may be under way. Call
/// on the connection's sequence of execution only, but for Post.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Keeps `events` until Close.
  virtual void Start(std::shared_ptr<ConnectionEvents> events) = 0;
  virtual void ReadHead() = 0;
  virtual void ReadBody() = 0;
  virtual void Write(std::string first, std::string second) = 0;
  /// OnPeerEnded and OnPeerClosed; for when nothing is being read. A client that only stops sending looks like one that
  /// has gone away, until something is written to it: `probe` is, from some time after its end up to the next Write.
  virtual void WatchPeer(std::string probe) = 0;
  virtual void StopWatching() = 0;
  /// The client sees the end of the answer, and may still be sending.
  virtual void CloseSending() = 0;
  virtual void Close() = 0;
  /// The address that the client has connected to, without the port: "127.0.0.1", "::1";
  /// empty behind a unix: address.
  [[nodiscard]] virtual std::string local_address() const = 0;
  /// Who the client is, as far as its connection proves it.
  [[nodiscard]] virtual net::PeerIdentity peer() const { return {}; }
  virtual void Post(std::function<void()> task) = 0;
};

}  // namespace dhpmap::http
