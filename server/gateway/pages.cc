// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/pages.h"

#include <google/protobuf/descriptor.h>

#include "server/gateway/http_rule_router.h"
#include "server/gateway/media_type.h"
#include "server/gateway/openapi.h"
#include "server/json/writer.h"

namespace dhpmap::gateway {
namespace {

http::Response TextPage(int status, std::string_view type, std::string body) {
  http::Response response;
  response.status = status;
  response.headers.emplace_back("Content-Type", type);
  response.headers.emplace_back("Cache-Control", "no-store");
  response.body = std::move(body);
  return response;
}

http::Response ReadyPage(const std::function<bool()>& is_ready) {
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
    json::AppendString(route.http_method + " " + route.path.text(), &out);
    out += R"(,"rpc":)";
    json::AppendString(route.method->full_name(), &out);
    out += '}';
  }
  return out + "\n]}\n";
}

}  // namespace

Pages::Pages(const HttpRuleRouter& router, GatewayHooks hooks) {
  const auto fixed = [](std::string_view type, std::string text) {
    return [type, text = std::move(text)] { return TextPage(200, type, text); };
  };
  pages_["/"] = fixed(kJsonType, IndexText(router));
  pages_["/healthz"] = fixed("text/plain; charset=utf-8", "ok\n");
  pages_["/openapi.json"] = fixed(kJsonType, OpenApiDocument(router));
  pages_["/readyz"] = [is_ready = std::move(hooks.is_ready)] { return ReadyPage(is_ready); };
  pages_[std::string(kMetricsPath)] = [text = std::move(hooks.metrics_text)] {
    return TextPage(200, "text/plain; version=0.0.4; charset=utf-8", text ? text() : "");
  };
}

}  // namespace dhpmap::gateway
