// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "server/gateway/hooks.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

class HttpRuleRouter;

/// Pages that the gateway serves without an RPC: the index, /healthz, /readyz, /metrics, /openapi.json. Thread-safe.
class Pages {
 public:
  Pages(const HttpRuleRouter& router, GatewayHooks hooks);

  [[nodiscard]] bool Has(std::string_view path) const { return pages_.find(path) != pages_.end(); }
  /// Whether making it may take milliseconds, too long for the connections' thread. Has(path) must be true.
  [[nodiscard]] static bool TakesTime(std::string_view path) { return path == kMetricsPath; }
  /// Whether it is public: liveness and readiness.
  [[nodiscard]] static bool IsForAll(std::string_view path) { return path == "/healthz" || path == "/readyz"; }
  /// The function that makes the page; it may be called on any thread, and after this is destroyed. Has(path) must be
  /// true.
  [[nodiscard]] std::function<http::Response()> MakerOf(std::string_view path) const {
    return pages_.find(path)->second;
  }
  [[nodiscard]] http::Response Make(std::string_view path) const { return pages_.find(path)->second(); }

 private:
  static constexpr std::string_view kMetricsPath = "/metrics";

  std::map<std::string, std::function<http::Response()>, std::less<>> pages_;
};

}  // namespace dhpmap::gateway
