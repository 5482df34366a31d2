// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/dispatcher.h"

#include <optional>
#include <string>
#include <utility>

#include "proto/types/resource_names.h"
#include "server/auth/rights.h"
#include "server/base/byte_budget.h"
#include "server/gateway/error_body.h"
#include "server/gateway/media_type.h"
#include "server/gateway/page_exchange.h"
#include "server/gateway/rpc_request.h"
#include "server/gateway/web_pages.h"
#include "server/gateway/who_asks.h"
#include "server/http/url.h"

namespace dhpmap::gateway {
namespace {

AnswerFormat FormatFor(const http::RequestHead& head) {
  return FormatOfAccept(http::FindHeader(head.headers, "accept"));
}

bool IsRead(const http::RequestHead& head) { return head.method == "GET" || head.method == "HEAD"; }

http::Response MethodNotAllowed(const http::RequestHead& head, std::string_view path, const std::string& allowed) {
  http::Response response = ErrorResponse(
      Status(StatusCode::kUnimplemented, head.method + " is not for " + std::string(path) + ": use " + allowed)
          .WithReason("METHOD_NOT_ALLOWED"),
      FormatFor(head));
  response.headers.emplace_back("Allow", allowed);
  return response;
}

}  // namespace

Dispatcher::Dispatcher(HttpRuleRouter router, RpcBackend backend, GatewayHooks hooks, std::size_t max_body_bytes,
                       std::shared_ptr<ByteBudget> inflight, AllowedOrigins origins)
    : router_(std::move(router)),
      gate_(hooks.gate != nullptr && hooks.gate->has_keys() ? hooks.gate : nullptr),
      pages_(router_, std::move(hooks)),
      backend_(backend),
      max_body_bytes_(max_body_bytes),
      inflight_(std::move(inflight)),
      origins_(std::move(origins)) {}

std::shared_ptr<http::Exchange> Dispatcher::Begin(const http::RequestHead& head,
                                                  const std::shared_ptr<http::Responder>& responder) const {
  if (origins_.empty()) return BeginFor(head, false, responder);
  std::optional<std::string> origin = origins_.OriginOf(head);
  const bool is_open = origin.has_value();
  return BeginFor(head, is_open, ForOrigin(std::move(origin), responder));
}

std::shared_ptr<http::Exchange> Dispatcher::BeginFor(const http::RequestHead& head, bool is_open,
                                                     const std::shared_ptr<http::Responder>& responder) const {
  const auto answer = [&](http::Response response) {
    responder->Reply(std::move(response));
    return nullptr;
  };
  const auto target = http::SplitTarget(head.target);
  if (!target) {
    return answer(
        ErrorResponse(InvalidArgument("the request target is not a path").WithReason("BAD_TARGET"), FormatFor(head)));
  }
  if (is_open && IsPreflight(head)) {
    const std::string methods = router_.AllowedMethods(target->path);
    return answer(PreflightAnswer(head, methods.empty() ? "GET, HEAD" : methods));
  }
  if (const Status url = gate_ ? CheckNoKeyInUrl(target->query) : Status::Ok(); !url.ok()) {
    return answer(ErrorResponse(url, FormatFor(head)));
  }
  if (gate_ && (target->path == kLogInPath || target->path == kLogOutPath)) {
    if (head.method != "POST") return answer(MethodNotAllowed(head, target->path, "POST"));
    return answer(target->path == kLogInPath ? LogIn(*gate_, head) : LogOut(*gate_, head));
  }
  if (auto page = WebPage(head, target->path)) {
    if (!IsRead(head)) return answer(MethodNotAllowed(head, target->path, "GET, HEAD"));
    return answer(*std::move(page));
  }
  if (pages_.Has(target->path)) {
    if (!IsRead(head)) return answer(MethodNotAllowed(head, target->path, "GET, HEAD"));
    if (const Status page = CheckPage(head, target->path); !page.ok()) {
      return answer(ErrorResponse(page, FormatFor(head)));
    }
    if (!Pages::TakesTime(target->path) || backend_.pages == nullptr) return answer(pages_.Make(target->path));
    return MakePageExchange(pages_.MakerOf(target->path), *backend_.pages, responder);
  }
  RouteMatch match = router_.Find(head.method, target->path);
  if (match.route == nullptr) return answer(NoRoute(head, target->path));
  auto exchange = BeginRpc(head, is_open, std::move(match), target->query, responder);
  if (!exchange.ok()) return answer(ErrorResponse(exchange.status(), FormatFor(head)));
  return std::move(*exchange);
}

http::Response Dispatcher::ErrorAnswer(const Status& error) const { return ErrorResponse(error, AnswerFormat::kAny); }

http::Response Dispatcher::NoRoute(const http::RequestHead& head, std::string_view path) const {
  const std::string allowed = router_.AllowedMethods(path);
  if (allowed.empty()) {
    return ErrorResponse(NotFound("there is nothing at " + std::string(path)).WithReason("UNKNOWN_PATH"),
                         FormatFor(head));
  }
  if (head.method != "OPTIONS") return MethodNotAllowed(head, path, allowed);
  http::Response response;
  response.status = 204;
  response.headers.emplace_back("Allow", allowed);
  return response;
}

Result<std::shared_ptr<http::Exchange>> Dispatcher::BeginRpc(const http::RequestHead& head, bool is_open,
                                                             RouteMatch match, std::string_view query,
                                                             const std::shared_ptr<http::Responder>& responder) const {
  // A page of another origin must not reach a server on the user's machine. Browsers name the origin; but requests that
  // they send without a preflight may look like curl's.
  if (head.is_from_foreign_page && !is_open && !IsRead(head)) {
    return Status(StatusCode::kPermissionDenied, "requests from web pages of another origin are not taken")
        .WithReason("FOREIGN_ORIGIN");
  }
  const bool is_stream = match.route->is_stream();
  auth::PrincipalPtr caller;
  if (const Status admitted = Admit(head, match, caller); !admitted.ok()) {
    (void)gate_->Audit({.principal = caller.get(), .rpc = match.route->rpc_path, .map = {}, .decision = admitted});
    return admitted;
  }
  DHPMAP_ASSIGN_OR_RETURN(RpcRequest request, RpcRequest::Make(head, std::move(match), query, max_body_bytes_));
  const auto budget = caller != nullptr ? gate_->BudgetOf(*caller, inflight_) : inflight_;
  if (caller != nullptr) CallFor(*gate_, std::move(caller), request.call);
  ByteShare share(budget.get());
  if (is_stream) return MakeStreamExchange(std::move(request), std::move(share), backend_, responder);
  if (!share.Resize(request.announced_bytes)) return TooManyBytes();
  return MakeUnaryExchange(std::move(request), std::move(share), backend_, responder);
}

Status Dispatcher::CheckPage(const http::RequestHead& head, std::string_view path) const {
  if (gate_ == nullptr || Pages::IsForAll(path)) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(const auth::PrincipalPtr principal, WhoAsks(*gate_, head));
  if (path != "/metrics" || principal->maps.match_all()) return Status::Ok();
  return Status(StatusCode::kPermissionDenied, "metrics name every map: they are for keys that are for all maps")
      .WithReason("MAP_NOT_ALLOWED");
}

Status Dispatcher::Admit(const http::RequestHead& head, const RouteMatch& match, auth::PrincipalPtr& principal) const {
  if (gate_ == nullptr) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(principal, WhoAsks(*gate_, head));
  const auth::CallNeeds* needs = gate_->NeedsOf(match.route->rpc_path);
  if (needs == nullptr) return Internal("an rpc says nothing of who may call it");
  DHPMAP_RETURN_IF_ERROR(auth::CheckRole(*principal, *needs));
  // The handler checks each message again; this check refuses a body before it arrives.
  for (const std::string& value : match.values) {
    if (!value.starts_with("maps/")) continue;
    DHPMAP_RETURN_IF_ERROR(auth::CheckMap(*principal, MapOfResource(value)));
  }
  return Status::Ok();
}

}  // namespace dhpmap::gateway
