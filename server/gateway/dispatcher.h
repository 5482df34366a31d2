// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "server/base/byte_budget.h"
#include "server/gateway/allowed_origins.h"
#include "server/gateway/hooks.h"
#include "server/gateway/http_rule_router.h"
#include "server/gateway/pages.h"
#include "server/gateway/rpc_exchange.h"
#include "server/http/exchange.h"

namespace dhpmap::gateway {

/// Maps a request to a page of the gateway, an RPC, or an error. Thread-safe.
class Dispatcher final : public http::Handler {
 public:
  /// The objects that `backend` points to must outlive this. Refuses bodies above `max_body_bytes`, and requests for
  /// which `inflight` has no room. Pages of `origins` may do what their keys permit.
  Dispatcher(HttpRuleRouter router, RpcBackend backend, GatewayHooks hooks, std::size_t max_body_bytes,
             std::shared_ptr<ByteBudget> inflight, AllowedOrigins origins = AllowedOrigins());

  std::shared_ptr<http::Exchange> Begin(const http::RequestHead& head,
                                        const std::shared_ptr<http::Responder>& responder) const override;
  /// google.rpc.Status in JSON.
  [[nodiscard]] http::Response ErrorAnswer(const Status& error) const override;

 private:
  /// `is_open`: the origin of the request's page is allowed.
  std::shared_ptr<http::Exchange> BeginFor(const http::RequestHead& head, bool is_open,
                                           const std::shared_ptr<http::Responder>& responder) const;
  [[nodiscard]] http::Response NoRoute(const http::RequestHead& head, std::string_view path) const;
  Result<std::shared_ptr<http::Exchange>> BeginRpc(const http::RequestHead& head, bool is_open, RouteMatch match,
                                                   std::string_view query,
                                                   const std::shared_ptr<http::Responder>& responder) const;

  /// Checks access to a page that is not public.
  [[nodiscard]] Status CheckPage(const http::RequestHead& head, std::string_view path) const;
  /// Whether the caller may call the RPC. Sets `principal` once it is known, also if the call is refused; null without
  /// keys.
  Status Admit(const http::RequestHead& head, const RouteMatch& match, auth::PrincipalPtr& principal) const;

  HttpRuleRouter router_;
  std::shared_ptr<auth::Gate> gate_;  ///< null: no access control
  Pages pages_;
  RpcBackend backend_;
  std::size_t max_body_bytes_;
  std::shared_ptr<ByteBudget> inflight_;
  AllowedOrigins origins_;
};

}  // namespace dhpmap::gateway
