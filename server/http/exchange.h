// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "server/http/message.h"

namespace dhpmap::http {

/// The connection's side of one request, which takes the answer. Call it on the connection's sequence of execution,
/// except Post. Call either Reply once, or BeginStream, then Chunk for each chunk in turn, then EndStream. After
/// Exchange::OnClosed only Post may be called.
class Responder {
 public:
  virtual ~Responder() = default;

  virtual void Reply(Response response) = 0;

  /// Sends the head with the first chunk. `length`: total size of the chunks, if known.
  virtual void BeginStream(Response head, std::optional<std::uint64_t> length) = 0;
  /// Sends the next chunk. Wait for Exchange::OnWritten before the next call: this is the back-pressure.
  virtual void Chunk(std::string data) = 0;
  /// `complete` false drops the connection, so that the client sees a truncated answer.
  virtual void EndStream(bool complete) = 0;

  /// Requests more of the body, after OnBody returned false.
  virtual void ResumeBody() = 0;
  /// Runs `task` on the connection's sequence of execution. Thread-safe.
  virtual void Post(std::function<void()> task) = 0;
};

/// The handler's side of one request. Called on the connection's sequence of execution.
class Exchange {
 public:
  virtual ~Exchange() = default;

  /// The next part of the body. Return false to pause until ResumeBody is called.
  virtual bool OnBody(std::string_view data) = 0;
  virtual void OnBodyEnd() = 0;
  /// The last chunk was passed on to the system.
  virtual void OnWritten() = 0;
  /// The client half-closed: it may wait for the answer or be gone, which only a write shows.
  virtual void OnPeerEnded() {}
  /// The client is gone, or the server stops: abandon the request.
  virtual void OnClosed() = 0;
};

/// Answers requests. Thread-safe; must outlive the server.
class Handler {
 public:
  virtual ~Handler() = default;

  /// Returns the exchange that takes the body and answers, or null if `responder` already has its reply.
  virtual std::shared_ptr<Exchange> Begin(const RequestHead& head,
                                          const std::shared_ptr<Responder>& responder) const = 0;
  /// The answer to malformed or too large requests. Reasons: MALFORMED_HTTP, HEADER_TOO_LARGE.
  [[nodiscard]] virtual Response ErrorAnswer(const Status& error) const = 0;
};

}  // namespace dhpmap::http
