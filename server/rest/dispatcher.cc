// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/dispatcher.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "server/rest/call_options.h"
#include "server/rest/json_writer.h"
#include "server/rest/openapi.h"
#include "server/rest/rpc_exchange.h"

namespace dhpmap::rest {
namespace {

HttpResponse TextPage(int status, std::string_view type, std::string body) {
  HttpResponse response;
  response.status = status;
  response.headers.emplace_back("Content-Type", type);
  response.headers.emplace_back("Cache-Control", "no-store");
  response.body = std::move(body);
  return response;
}

HttpResponse ReadyPage(const std::function<bool()>& is_ready) {
  const bool ready = !is_ready || is_ready();
  return TextPage(ready ? 200 : 503, "text/plain; charset=utf-8", ready ? "ready\n" : "not ready\n");
}

std::string IndexText(const HttpRuleRouter& router) {
  std::string out =
      R"({"name":"dhpmap","openapi":"/openapi.json","health":"/healthz","ready":"/readyz","metrics":"/metrics",)";
  out += R"("methods":[)";
  bool first = true;
  for (const Route& route : router.routes()) {
    out += first ? "\n" : ",\n";
    first = false;
    out += R"({"http":)";
    AppendJsonString(route.http_method + " " + route.path.text(), &out);
    out += R"(,"rpc":)";
    AppendJsonString(route.method->full_name(), &out);
    out += '}';
  }
  return out + "\n]}\n";
}

/// A web page of another origin must not reach a server on the user's own machine: browsers say where they come from,
/// and what they send without asking first may look like curl's.
bool ComesFromForeignPage(const RequestHead& head) {
  if (head.method == "GET" || head.method == "HEAD") return false;
  std::string_view origin = FindHeader(head.headers, "origin");
  if (origin.empty()) return false;
  const std::size_t scheme = origin.find("://");
  if (scheme != std::string_view::npos) origin.remove_prefix(scheme + 3);
  return !EqualsIgnoringCase(origin, FindHeader(head.headers, "host"));
}

bool HasBody(const RequestHead& head) {
  return head.content_length.value_or(0) > 0 || !FindHeader(head.headers, "transfer-encoding").empty();
}

/// The last path value with only harmless characters: "maps/home/submaps/3" -> "maps_home_submaps_3".
std::string FileStem(const RouteMatch& match) {
  std::string stem = match.values.empty() ? std::string() : match.values.back().substr(0, 128);
  std::replace_if(
      stem.begin(), stem.end(),
      [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.');
      },
      '_');
  return stem.empty() ? "download" : stem;
}

}  // namespace

Dispatcher::Dispatcher(HttpRuleRouter router, RpcCaller* caller, GatewayHooks hooks, std::size_t max_body_bytes)
    : router_(std::move(router)), caller_(caller), max_body_bytes_(max_body_bytes) {
  AddPages(std::move(hooks));
}

void Dispatcher::AddPages(GatewayHooks hooks) {
  const auto fixed = [](std::string_view type, std::string text) {
    return [type, text = std::move(text)] { return TextPage(200, type, text); };
  };
  pages_["/"] = fixed(kJsonType, IndexText(router_));
  pages_["/healthz"] = fixed("text/plain; charset=utf-8", "ok\n");
  pages_["/openapi.json"] = fixed(kJsonType, OpenApiDocument(router_));
  pages_["/readyz"] = [is_ready = std::move(hooks.is_ready)] { return ReadyPage(is_ready); };
  pages_["/metrics"] = [text = std::move(hooks.metrics_text)] {
    return TextPage(200, "text/plain; version=0.0.4; charset=utf-8", text ? text() : "");
  };
}

std::shared_ptr<Exchange> Dispatcher::Begin(const RequestHead& head,
                                            const std::shared_ptr<Responder>& responder) const {
  const AnswerFormat format = FormatOfAccept(FindHeader(head.headers, "accept"));
  const auto target = SplitTarget(head.target);
  if (!target) {
    responder->Reply(
        ErrorResponse(InvalidArgument("the request target is not a path").WithReason("BAD_TARGET"), format));
    return nullptr;
  }
  if (const auto page = pages_.find(target->path); page != pages_.end()) {
    if (head.method == "GET" || head.method == "HEAD") {
      responder->Reply(page->second());
    } else {
      HttpResponse wrong = ErrorResponse(Status(StatusCode::kUnimplemented, head.method + " is not for " + page->first)
                                             .WithReason("METHOD_NOT_ALLOWED"),
                                         format, 405);
      wrong.headers.emplace_back("Allow", "GET, HEAD");
      responder->Reply(std::move(wrong));
    }
    return nullptr;
  }
  RouteMatch match = router_.Find(head.method, target->path);
  if (match.route == nullptr) {
    responder->Reply(NoRoute(head, target->path));
    return nullptr;
  }
  int http_status = 0;
  auto exchange = BeginRpc(head, std::move(match), target->query, responder, &http_status);
  if (exchange.ok()) return std::move(*exchange);
  responder->Reply(ErrorResponse(exchange.status(), format, http_status));
  return nullptr;
}

HttpResponse Dispatcher::NoRoute(const RequestHead& head, std::string_view path) const {
  const AnswerFormat format = FormatOfAccept(FindHeader(head.headers, "accept"));
  const std::string allowed = router_.AllowedMethods(path);
  if (allowed.empty()) {
    return ErrorResponse(NotFound("there is nothing at " + std::string(path)).WithReason("UNKNOWN_PATH"), format);
  }
  if (head.method == "OPTIONS") {
    HttpResponse response;
    response.status = 204;
    response.headers.emplace_back("Allow", allowed);
    return response;
  }
  HttpResponse response = ErrorResponse(
      Status(StatusCode::kUnimplemented, head.method + " is not for " + std::string(path) + ": use " + allowed)
          .WithReason("METHOD_NOT_ALLOWED"),
      format, 405);
  response.headers.emplace_back("Allow", allowed);
  return response;
}

Result<std::shared_ptr<Exchange>> Dispatcher::BeginRpc(const RequestHead& head, RouteMatch match,
                                                       std::string_view query,
                                                       const std::shared_ptr<Responder>& responder,
                                                       int* http_status) const {
  const Route& route = *match.route;
  if (ComesFromForeignPage(head)) {
    return Status(StatusCode::kPermissionDenied, "requests from web pages of another origin are not taken")
        .WithReason("FOREIGN_ORIGIN");
  }
  const std::string_view content_type = FindHeader(head.headers, "content-type");
  auto body_format = FormatOfContentType(content_type);
  if (!HasBody(head) || route.body == Route::Body::kNone) body_format = body_format.value_or(BodyFormat::kJson);
  const std::string_view encoding = FindHeader(head.headers, "content-encoding");
  if (!body_format || !(encoding.empty() || EqualsIgnoringCase(encoding, "identity"))) {
    *http_status = 415;
    return InvalidArgument(!body_format ? "content type '" + std::string(content_type) +
                                              "' is not taken: send application/json or application/x-protobuf"
                                        : "content encoding '" + std::string(encoding) + "' is not taken")
        .WithReason("UNSUPPORTED_MEDIA_TYPE");
  }
  if (*body_format == BodyFormat::kDelimitedProtobuf && !route.client_streams()) {
    *http_status = 415;
    return InvalidArgument("this RPC takes one message: send it as application/x-protobuf")
        .WithReason("UNSUPPORTED_MEDIA_TYPE");
  }
  if (head.content_length.value_or(0) > max_body_bytes_ && !route.client_streams()) {
    *http_status = 413;
    return ResourceExhausted("the body has " + std::to_string(*head.content_length) + " bytes, more than " +
                             std::to_string(max_body_bytes_))
        .WithReason("BODY_TOO_LARGE");
  }
  DHPMAP_ASSIGN_OR_RETURN(CallOptions call, MakeCallOptions(route.rpc_path, head.headers));
  std::string file_stem = FileStem(match);
  DHPMAP_ASSIGN_OR_RETURN(RequestTranscoder transcoder, RequestTranscoder::Make(std::move(match), query));
  RpcRequest request{
      &route,          std::move(transcoder), *body_format,          FormatOfAccept(FindHeader(head.headers, "accept")),
      std::move(call), max_body_bytes_,       head.method == "HEAD", std::move(file_stem)};
  return route.is_stream() ? MakeStreamExchange(std::move(request), caller_, responder)
                           : MakeUnaryExchange(std::move(request), caller_, responder);
}

}  // namespace dhpmap::rest
