// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "server/http/connection.h"

namespace dhpmap::http {

/// Parses one HTTP/1.1 request from pieces of any size: its head, then its body without framing. Bytes that it does not
/// consume, at most kMaxHead_bytes, must be passed again with more data. The result does not depend on the pieces.
/// Thread-compatible.
class RequestParser {
 public:
  /// Limit of a request's head, and of the framing between two parts of a body if it is split.
  static constexpr std::size_t kMaxHead_bytes = 32u << 10;

  RequestParser();
  ~RequestParser();
  RequestParser(RequestParser&&) noexcept;
  RequestParser& operator=(RequestParser&&) noexcept;

  struct HeadStep {
    std::size_t num_used = 0;
    bool is_complete = false;  ///< `head` is the result or an error; else more bytes are needed
    HeadResult head;
  };
  HeadStep AddHead(std::string_view bytes);

  struct BodyStep {
    std::size_t num_used = 0;
    std::size_t num_written = 0;  ///< to `out`
    ReadOutcome outcome = ReadOutcome::kOk;
    bool is_end = false;
    /// Whether there is a result; else more bytes are needed.
    [[nodiscard]] bool is_complete() const { return num_written > 0 || is_end || outcome != ReadOutcome::kOk; }
  };
  /// Call after a head that announces a body. `out` must not be empty.
  BodyStep AddBody(std::string_view bytes, std::span<char> out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::http
