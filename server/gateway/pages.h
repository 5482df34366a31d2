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

/// What the gateway answers itself, without any RPC: the index, /healthz, /readyz, /metrics, /openapi.json.
/// Thread-safe.
class Pages {
 public:
  Pages(const HttpRuleRouter& router, GatewayHooks hooks);

  [[nodiscard]] bool Has(std::string_view path) const { return pages_.find(path) != pages_.end(); }
  /// Made anew each time. `path` is one that Has knows.
  [[nodiscard]] http::Response Make(std::string_view path) const { return pages_.find(path)->second(); }

 private:
  std::map<std::string, std::function<http::Response()>, std::less<>> pages_;
};

}  // namespace dhpmap::gateway
