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

/// Origins whose web pages may use the API (CORS), with a key that they send themselves: never with the cookie of a
/// login, which counts for pages of this server alone. Immutable, so thread-safe.
class AllowedOrigins {
 public:
  /// As browsers send them: "https://fleet.example:8443", in small letters, no default port, no slash behind it.
  explicit AllowedOrigins(std::vector<std::string> origins = {}) : origins_(std::move(origins)) {}

  [[nodiscard]] bool empty() const { return origins_.empty(); }
  /// Of the page that sends the request, if it is one of these.
  [[nodiscard]] std::optional<std::string> OriginOf(const http::RequestHead& head) const;

 private:
  std::vector<std::string> origins_;
};

/// Whether a browser asks if it may send another request, which it does without any key.
bool IsPreflight(const http::RequestHead& head);
/// `methods`: "GET, HEAD, POST", those of the path.
http::Response PreflightAnswer(const http::RequestHead& head, std::string_view methods);

/// Passes on to `responder`, saying in each head that the page of `origin` may read the answer; that of none may not.
/// What caches have for one origin they must not give to another.
std::shared_ptr<http::Responder> ForOrigin(std::optional<std::string> origin,
                                           std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
