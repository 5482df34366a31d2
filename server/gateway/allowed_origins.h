// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/exchange.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

/// Origins whose web pages may use the API (CORS) with a key that they send themselves. The login cookie never counts
/// for them: it is valid for pages of this server only. Immutable, so thread-safe.
class AllowedOrigins {
 public:
  /// In the form that browsers send: "https://fleet.example:8443", lower case, no default port, no trailing slash.
  explicit AllowedOrigins(std::vector<std::string> origins = {}) : origins_(std::move(origins)) {}

  [[nodiscard]] bool empty() const { return origins_.empty(); }
  /// The origin of the request's page, if it is allowed.
  [[nodiscard]] std::optional<std::string> OriginOf(const http::RequestHead& head) const;

 private:
  std::vector<std::string> origins_;
};

/// Whether this is a CORS preflight, which browsers send without credentials.
bool IsPreflight(const http::RequestHead& head);
/// `methods`: those of the path, such as "GET, HEAD, POST".
http::Response PreflightAnswer(const http::RequestHead& head, std::string_view methods);

/// Forwards to `responder` and adds the CORS headers that let a page of `origin` read the answer; without an origin
/// none may. Adds Vary, so that caches keep answers for each origin apart.
std::shared_ptr<http::Responder> ForOrigin(std::optional<std::string> origin,
                                           std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
