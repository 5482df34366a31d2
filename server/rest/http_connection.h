// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/rest/http_message.h"

namespace dhpmap::rest {

enum class ReadOutcome { kOk, kClosed, kTimedOut, kMalformed, kTooLarge };

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
  virtual void OnPeerClosed() = 0;
};

/// One TCP connection that speaks HTTP/1.1: reads requests, writes bytes. One read and one write may be under way. Call
/// on the connection's sequence of execution only, but for Post.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Keeps `events` until Close.
  virtual void Start(std::shared_ptr<ConnectionEvents> events) = 0;
  virtual void ReadHead() = 0;
  virtual void ReadBody() = 0;
  virtual void Write(std::string first, std::string second) = 0;
  /// OnPeerClosed when the client goes away; for when nothing is being read.
  virtual void WatchPeer() = 0;
  virtual void StopWatching() = 0;
  /// The client sees the end of the answer, and may still be sending.
  virtual void CloseSending() = 0;
  virtual void Close() = 0;
  virtual void Post(std::function<void()> task) = 0;
};

}  // namespace dhpmap::rest
