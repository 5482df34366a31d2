// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/allowed_origins.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace dhpmap::gateway {
namespace {

/// Headers besides those that every page may send and read.
constexpr std::string_view kRequestHeaders =
    "Accept, Authorization, Content-Type, If-Match, If-None-Match, Last-Event-ID, X-Request-Id, X-Timeout-S, "
    "traceparent, tracestate";
constexpr std::string_view kAnswerHeaders = "Content-Disposition, ETag, Retry-After, WWW-Authenticate, X-Request-Id";
constexpr std::string_view kKeep_s = "600";

class OriginResponder final : public http::Responder {
 public:
  OriginResponder(std::optional<std::string> origin, std::shared_ptr<http::Responder> responder)
      : origin_(std::move(origin)), responder_(std::move(responder)) {}

  void Reply(http::Response response) override { responder_->Reply(Opened(std::move(response))); }
  void BeginStream(http::Response head, std::optional<std::uint64_t> length) override {
    responder_->BeginStream(Opened(std::move(head)), length);
  }
  void Chunk(std::string data) override { responder_->Chunk(std::move(data)); }
  void EndStream(bool complete) override { responder_->EndStream(complete); }
  void ResumeBody() override { responder_->ResumeBody(); }
  void Post(std::function<void()> task) override { responder_->Post(std::move(task)); }

 private:
  [[nodiscard]] http::Response Opened(http::Response response) const {
    response.headers.emplace_back("Vary", "Origin");
    if (!origin_) return response;
    response.headers.emplace_back("Access-Control-Allow-Origin", *origin_);
    response.headers.emplace_back("Access-Control-Expose-Headers", kAnswerHeaders);
    return response;
  }

  const std::optional<std::string> origin_;
  const std::shared_ptr<http::Responder> responder_;
};

}  // namespace

std::optional<std::string> AllowedOrigins::OriginOf(const http::RequestHead& head) const {
  std::optional<std::string> found;
  for (const auto& [name, value] : head.headers) {
    if (!http::EqualsIgnoringCase(name, "origin")) continue;
    if (found) return std::nullopt;  // a browser sends exactly one
    found = value;
  }
  const bool is_allowed = found && std::find(origins_.begin(), origins_.end(), *found) != origins_.end();
  return is_allowed ? found : std::nullopt;
}

bool IsPreflight(const http::RequestHead& head) {
  return head.method == "OPTIONS" && !http::FindHeader(head.headers, "access-control-request-method").empty();
}

http::Response PreflightAnswer(const http::RequestHead& head, std::string_view methods) {
  http::Response response;
  response.status = 204;
  response.headers = {{"Access-Control-Allow-Methods", std::string(methods)},
                      {"Access-Control-Allow-Headers", std::string(kRequestHeaders)},
                      {"Access-Control-Max-Age", std::string(kKeep_s)}};
  // A page on the internet also needs permission to reach a machine in this network, or this one.
  if (http::FindHeader(head.headers, "access-control-request-private-network") == "true") {
    response.headers.emplace_back("Access-Control-Allow-Private-Network", "true");
  }
  return response;
}

std::shared_ptr<http::Responder> ForOrigin(std::optional<std::string> origin,
                                           std::shared_ptr<http::Responder> responder) {
  return std::make_shared<OriginResponder>(std::move(origin), std::move(responder));
}

}  // namespace dhpmap::gateway
