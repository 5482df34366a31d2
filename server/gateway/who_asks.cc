// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/who_asks.h"

#include <utility>
#include <vector>

#include "server/gateway/error_body.h"
#include "server/http/url.h"

namespace dhpmap::gateway {

namespace {

/// The prefix makes browsers accept the cookie only over a secure connection, or from this machine, and send it to this
/// host only.
constexpr std::string_view kCookie = "__Host-dhpmap";

std::vector<std::string_view> ValuesOf(const http::RequestHead& head, std::string_view wanted) {
  std::vector<std::string_view> values;
  for (const auto& [name, value] : head.headers) {
    if (http::EqualsIgnoringCase(name, wanted)) values.push_back(value);
  }
  return values;
}

/// "a=1; __Host-dhpmap=..." -> the values of our cookies.
std::vector<std::string_view> LoginsOf(const http::RequestHead& head) {
  std::vector<std::string_view> words;
  for (std::string_view left : ValuesOf(head, "cookie")) {
    while (!left.empty()) {
      const std::size_t end = left.find(';');
      std::string_view pair = left.substr(0, end);
      left.remove_prefix(end == std::string_view::npos ? left.size() : end + 1);
      while (pair.starts_with(' ')) pair.remove_prefix(1);
      if (pair.starts_with(kCookie) && pair.substr(kCookie.size()).starts_with('=')) {
        words.push_back(pair.substr(kCookie.size() + 1));
      }
    }
  }
  return words;
}

bool IsFromOwnPage(const http::RequestHead& head) {
  if (head.is_from_foreign_page) return false;
  // Prefer sec-fetch-site where browsers send it: a page at another port of this host is foreign.
  const std::string_view site = http::FindHeader(head.headers, "sec-fetch-site");
  return site.empty() ? !http::FindHeader(head.headers, "origin").empty() : site == "same-origin";
}

Status ForeignPage() {
  return Status(StatusCode::kPermissionDenied, "a login counts for pages of this server alone")
      .WithReason("FOREIGN_ORIGIN");
}

http::Response Done(std::string_view word, std::int64_t life_s) {
  http::Response response;
  response.status = 204;
  response.headers = {{"Set-Cookie", std::string(kCookie) + "=" + std::string(word) + "; Path=/; Max-Age=" +
                                         std::to_string(life_s) + "; HttpOnly; Secure; SameSite=Strict"},
                      {"Cache-Control", "no-store"}};
  return response;
}

}  // namespace

Result<auth::PrincipalPtr> WhoAsks(auth::Gate& gate, const http::RequestHead& head) {
  std::vector<std::string_view> keys = ValuesOf(head, "authorization");
  const std::vector<std::string_view> words = LoginsOf(head);
  if (words.empty()) return gate.AuthenticateFrom(head.peer_key, keys);
  if (!keys.empty() || words.size() > 1) {
    return InvalidArgument("the request shows more than one key or login").WithReason("AMBIGUOUS_CREDENTIAL");
  }
  if (!IsFromOwnPage(head)) return ForeignPage();
  return gate.AuthenticateLogin(words.front());
}

http::Response LogIn(auth::Gate& gate, const http::RequestHead& head) {
  if (head.is_from_foreign_page) return ErrorResponse(ForeignPage(), AnswerFormat::kAny);
  // A login while logged in replaces the principal.
  auto principal = gate.AuthenticateFrom(head.peer_key, ValuesOf(head, "authorization"));
  Status counted = principal.ok() ? gate.Count(**principal) : principal.status();
  const Status written = gate.Audit(
      {.principal = principal.ok() ? principal->get() : nullptr, .rpc = "/ui/login", .map = {}, .decision = counted});
  if (counted.ok()) counted = written;
  if (!counted.ok()) return ErrorResponse(counted, AnswerFormat::kAny);
  return Done(gate.LogIn(*std::move(principal)), auth::LoginSessions::kLife_s);
}

http::Response LogOut(auth::Gate& gate, const http::RequestHead& head) {
  if (head.is_from_foreign_page) return ErrorResponse(ForeignPage(), AnswerFormat::kAny);
  for (const std::string_view word : LoginsOf(head)) gate.LogOut(word);
  return Done("", 0);
}

Status CheckNoKeyInUrl(std::string_view query) {
  const auto pairs = http::ParseQuery(query);
  if (!pairs) return Status::Ok();  // reported where the query is parsed
  for (const auto& [name, value] : *pairs) {
    if (name != "access_token" && !value.starts_with("dhp_")) continue;
    return InvalidArgument(
               "a key must not be in a URL: send it as 'Authorization: Bearer dhp_...', and rotate this one")
        .WithReason("TOKEN_IN_URL");
  }
  return Status::Ok();
}

void CallFor(auth::Gate& gate, auth::PrincipalPtr principal, CallOptions& call) {
  std::erase_if(call.metadata, [](const auto& entry) { return entry.first == "authorization"; });
  const auto ticket = gate.tickets().Issue(std::move(principal));
  call.metadata.emplace_back(auth::kTicketKey, ticket->text());
  call.kept = ticket;
}

}  // namespace dhpmap::gateway
