// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "server/rest/gateway.h"
#include "server/rest/http_message.h"
#include "server/rest/http_rule_router.h"
#include "server/rest/rpc_call.h"

namespace dhpmap::rest {

/// Decides what a request is: a page of the gateway's own, an RPC, or an error. Thread-safe.
class Dispatcher {
 public:
  /// `caller` outlives this.
  Dispatcher(HttpRuleRouter router, RpcCaller* caller, GatewayHooks hooks, std::size_t max_body_bytes);

  /// The exchange that takes the body and answers, or null if `responder` has its reply already.
  std::shared_ptr<Exchange> Begin(const RequestHead& head, const std::shared_ptr<Responder>& responder) const;

  [[nodiscard]] const HttpRuleRouter& router() const { return router_; }

 private:
  void AddPages(GatewayHooks hooks);
  Result<std::shared_ptr<Exchange>> BeginRpc(const RequestHead& head, RouteMatch match, std::string_view query,
                                             const std::shared_ptr<Responder>& responder, int* http_status) const;
  [[nodiscard]] HttpResponse NoRoute(const RequestHead& head, std::string_view path) const;

  HttpRuleRouter router_;
  RpcCaller* caller_;
  std::size_t max_body_bytes_;
  std::map<std::string, std::function<HttpResponse()>, std::less<>> pages_;
};

}  // namespace dhpmap::rest
