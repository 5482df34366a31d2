// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/host_names.h"

#include <algorithm>
#include <utility>

namespace dhpmap::http {
namespace {

bool IsHostCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_';
}

bool IsAddressCharacter(char c) { return IsHostCharacter(c) || c == ':' || c == '%'; }

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// All values of one header.
std::vector<std::string_view> ValuesOf(const Headers& headers, std::string_view name) {
  std::vector<std::string_view> values;
  for (const auto& [key, value] : headers) {
    if (EqualsIgnoringCase(key, name)) values.push_back(value);
  }
  return values;
}

/// The authority in "http://host:port/path"; empty for the origin form ("/path").
std::string_view AuthorityOfTarget(std::string_view target) {
  const std::size_t scheme = target.find("://");
  if (scheme == std::string_view::npos || target.front() == '/') return {};
  target.remove_prefix(scheme + 3);
  return target.substr(0, target.find_first_of("/?#"));
}

/// The authority that a request addresses: the target takes precedence over Host (RFC 9112, 3.2.2).
std::string_view AuthorityOf(const RequestHead& head) {
  const std::string_view of_target = AuthorityOfTarget(head.target);
  return of_target.empty() ? FindHeader(head.headers, "host") : of_target;
}

std::string_view WithoutDefaultPort(std::string_view port) { return port == "80" || port == "443" ? "" : port; }

}  // namespace

std::optional<Authority> SplitAuthority(std::string_view text) {
  Authority authority;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    authority.host = text.substr(1, end - 1);
    text.remove_prefix(end + 1);
    if (!std::all_of(authority.host.begin(), authority.host.end(), IsAddressCharacter)) return std::nullopt;
  } else {
    authority.host = text.substr(0, text.find(':'));
    text.remove_prefix(authority.host.size());
    if (!std::all_of(authority.host.begin(), authority.host.end(), IsHostCharacter)) return std::nullopt;
  }
  if (authority.host.empty()) return std::nullopt;
  if (text.empty()) return authority;
  authority.port = text.substr(1);
  const bool is_port = text.front() == ':' && authority.port.size() <= 5 &&
                       std::all_of(authority.port.begin(), authority.port.end(), IsDigit);
  if (!is_port) return std::nullopt;
  return authority;
}

HostNames::HostNames(std::string bound_host, std::vector<std::string> allowed)
    : bound_host_(std::move(bound_host)), allowed_(std::move(allowed)) {}

bool HostNames::IsAllowed(std::string_view host) const {
  return std::any_of(allowed_.begin(), allowed_.end(),
                     [&](const std::string& name) { return EqualsIgnoringCase(name, host); });
}

bool HostNames::IsOurs(std::string_view host, std::string_view local_address) const {
  for (const std::string_view name : {std::string_view("localhost"), std::string_view("127.0.0.1"),
                                      std::string_view("::1"), std::string_view(bound_host_), local_address}) {
    if (EqualsIgnoringCase(name, host)) return true;
  }
  return IsAllowed(host);
}

Status HostNames::Check(const RequestHead& head, bool is_http_1_1, std::string_view local_address) const {
  const auto hosts = ValuesOf(head.headers, "host");
  if (hosts.size() > 1) return InvalidArgument("the request has more than one Host").WithReason("MALFORMED_HTTP");
  if (hosts.empty() && is_http_1_1) return InvalidArgument("the request has no Host").WithReason("MALFORMED_HTTP");
  std::vector<std::string_view> names = hosts;
  if (const auto of_target = AuthorityOfTarget(head.target); !of_target.empty()) names.push_back(of_target);
  for (const std::string_view name : names) {
    const auto authority = SplitAuthority(name);
    if (!authority) return InvalidArgument("the request's Host is malformed").WithReason("MALFORMED_HTTP");
    if (!IsOurs(authority->host, local_address)) {
      return Status(StatusCode::kPermissionDenied, "this server is not called '" + std::string(authority->host) +
                                                       "': http.allowed_hosts may list further names")
          .WithReason("HOST_NOT_ALLOWED");
    }
  }
  return Status::Ok();
}

bool HostNames::IsFromForeignPage(const RequestHead& head, std::string_view local_address) const {
  const auto origins = ValuesOf(head.headers, "origin");
  if (origins.empty()) return false;
  const std::size_t scheme = origins.front().find("://");
  if (origins.size() > 1 || scheme == std::string_view::npos) return true;
  const auto origin = SplitAuthority(origins.front().substr(scheme + 3));
  if (!origin) return true;
  if (IsAllowed(origin->host)) return false;
  if (!IsOurs(origin->host, local_address)) return true;
  // Another server on this machine has the same host, but another port.
  const auto addressed = SplitAuthority(AuthorityOf(head));
  return !addressed || !EqualsIgnoringCase(addressed->host, origin->host) ||
         WithoutDefaultPort(addressed->port) != WithoutDefaultPort(origin->port);
}

}  // namespace dhpmap::http
