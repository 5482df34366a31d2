// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap::http {

struct HttpAnswer {
  int status = 0;  ///< 0: the connection ended before a whole head
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;         ///< without chunk framing
  bool is_complete = true;  ///< false: the connection ended before the end of the body
  bool was_chunked = false;

  [[nodiscard]] std::string Header(std::string_view name) const;
};

/// A blocking HTTP/1.1 client on one connection to 127.0.0.1, that can also send what no proper client would. Reading
/// and sending end after a time that only what hangs needs.
class HttpClient {
 public:
  explicit HttpClient(int port);
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  using Headers = std::vector<std::pair<std::string, std::string>>;
  /// Sends a whole request and reads the answer. A Content-Length is added if there is a body.
  HttpAnswer Ask(std::string_view method, std::string_view target, std::string_view body = {}, Headers headers = {});

  bool SendRaw(std::string_view bytes);
  /// `is_head`: the answer has no body, whatever its head says.
  HttpAnswer ReadAnswer(bool is_head = false);
  /// The next bytes of the stream, at least one; "" at its end.
  std::string ReadSome();
  void CloseSending();
  /// Whether the server closes the connection within the timeout of a read.
  bool IsClosedByServer();

 private:
  bool Fill();
  bool FillTo(std::size_t size);

  int socket_ = -1;
  std::string buffer_;
};

}  // namespace dhpmap::http
