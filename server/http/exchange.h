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

/// The connection's side of one request: takes the answer. All calls on the connection's own sequence of execution,
/// except Post. Either Reply once, or BeginStream, chunks one at a time, EndStream. After Exchange::OnClosed nothing
/// may be called but Post.
class Responder {
 public:
  virtual ~Responder() = default;

  virtual void Reply(Response response) = 0;

  /// Sends the head with the first chunk. `length` is the size of all chunks where it is known.
  virtual void BeginStream(Response head, std::optional<std::uint64_t> length) = 0;
  /// The next only after Exchange::OnWritten: this is the back-pressure.
  virtual void Chunk(std::string data) = 0;
  /// `complete` false drops the connection, so that the client sees that the answer is cut off.
  virtual void EndStream(bool complete) = 0;

  /// Asks for more of the body, after OnBody returned false.
  virtual void ResumeBody() = 0;
  /// Runs `task` on the connection's sequence of execution. Thread-safe.
  virtual void Post(std::function<void()> task) = 0;
};

/// The handler's side of one request. Calls come on the connection's sequence of execution.
class Exchange {
 public:
  virtual ~Exchange() = default;

  /// Next part of the body. False: no more until ResumeBody is called.
  virtual bool OnBody(std::string_view data) = 0;
  virtual void OnBodyEnd() = 0;
  /// The last chunk is on its way.
  virtual void OnWritten() = 0;
  /// The client sends nothing any more: it may be waiting for the answer, or be gone, which is told when something is
  /// written.
  virtual void OnPeerEnded() {}
  /// The client is gone, or the server stops: give up.
  virtual void OnClosed() = 0;
};

/// What answers requests. Thread-safe; outlives the server.
class Handler {
 public:
  virtual ~Handler() = default;

  /// The exchange that takes the body and answers, or null if `responder` has its reply already.
  virtual std::shared_ptr<Exchange> Begin(const RequestHead& head,
                                          const std::shared_ptr<Responder>& responder) const = 0;
  /// The answer to what is not HTTP, or more of it than is taken. Reasons: MALFORMED_HTTP, HEADER_TOO_LARGE.
  [[nodiscard]] virtual Response ErrorAnswer(const Status& error) const = 0;
};

}  // namespace dhpmap::http
