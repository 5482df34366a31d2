// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "server/http/connection.h"

namespace dhpmap::http {

/// Reads one request of HTTP/1.1 out of bytes that come in pieces of any size: its head, then its body without the
/// framing. What it has not used, kMaxHead_bytes at most, belongs to what comes later and is given again, with more
/// behind it. The outcome does not depend on the pieces. Thread-compatible.
class RequestParser {
 public:
  /// Of a request's head. Also of what stands between two parts of a body, if it comes in pieces.
  static constexpr std::size_t kMaxHead_bytes = 32u << 10;

  RequestParser();
  ~RequestParser();
  RequestParser(RequestParser&&) noexcept;
  RequestParser& operator=(RequestParser&&) noexcept;

  struct HeadStep {
    std::size_t num_used = 0;
    bool is_complete = false;  ///< `head` says what it is, or what is wrong with it; else more bytes are needed
    HeadResult head;
  };
  HeadStep AddHead(std::string_view bytes);

  struct BodyStep {
    std::size_t num_used = 0;
    std::size_t num_written = 0;  ///< to `out`
    ReadOutcome outcome = ReadOutcome::kOk;
    bool is_end = false;
    /// There is something to tell; else more bytes are needed.
    [[nodiscard]] bool is_complete() const { return num_written > 0 || is_end || outcome != ReadOutcome::kOk; }
  };
  /// After the head, if that says that there is a body. `out` is not empty.
  BodyStep AddBody(std::string_view bytes, std::span<char> out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::http
