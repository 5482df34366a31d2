// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap::rest {

using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

/// First value of that name, whatever its case; "" if there is none.
std::string_view FindHeader(const HttpHeaders& headers, std::string_view name);
bool EqualsIgnoringCase(std::string_view a, std::string_view b);

/// A request without its body.
struct RequestHead {
  std::string method;
  std::string target;
  HttpHeaders headers;
  std::optional<std::uint64_t> content_length;
};

struct HttpResponse {
  int status = 200;
  HttpHeaders headers;  ///< not Content-Length, Transfer-Encoding, Connection, Date
  std::string body;
};

std::string_view ReasonPhrase(int status);

/// The connection's side of one request: takes the answer. All calls on the connection's own sequence of execution,
/// except Post. Either Reply once, or BeginStream, chunks one at a time, EndStream. After Exchange::OnClosed nothing
/// may be called but Post.
class Responder {
 public:
  virtual ~Responder() = default;

  virtual void Reply(HttpResponse response) = 0;

  /// Sends the head with the first chunk. `length` is the size of all chunks where it is known.
  virtual void BeginStream(HttpResponse head, std::optional<std::uint64_t> length) = 0;
  /// The next only after Exchange::OnWritten: this is the back-pressure.
  virtual void Chunk(std::string data) = 0;
  /// `complete` false drops the connection, so that the client sees that the answer is cut off.
  virtual void EndStream(bool complete) = 0;

  /// Asks for more of the body, after OnBody returned false.
  virtual void ResumeBody() = 0;
  /// Runs `task` on the connection's sequence of execution. Thread-safe.
  virtual void Post(std::function<void()> task) = 0;
};

/// The gateway's side of one request. Calls come on the connection's sequence of execution.
class Exchange {
 public:
  virtual ~Exchange() = default;

  /// Next part of the body. False: no more until ResumeBody is called.
  virtual bool OnBody(std::string_view data) = 0;
  virtual void OnBodyEnd() = 0;
  /// The last chunk is on its way.
  virtual void OnWritten() = 0;
  /// The client is gone, or the server stops: give up.
  virtual void OnClosed() = 0;
};

}  // namespace dhpmap::rest
