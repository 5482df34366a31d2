// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap::http {

using Headers = std::vector<std::pair<std::string, std::string>>;

/// The first header of that name, case-insensitive; "" if missing.
std::string_view FindHeader(const Headers& headers, std::string_view name);
bool EqualsIgnoringCase(std::string_view a, std::string_view b);

/// A request without its body.
struct RequestHead {
  std::string method;
  std::string target;
  Headers headers;
  std::optional<std::uint64_t> content_length;
  std::string peer_key;               ///< net::PeerKey of the client; empty for a unix: address
  bool is_from_foreign_page = false;  ///< sent by a web page of another origin
};

struct Response {
  int status = 200;
  Headers headers;  ///< without Content-Length, Transfer-Encoding, Connection, Date
  std::string body;
};

std::string_view ReasonPhrase(int status);

}  // namespace dhpmap::http
