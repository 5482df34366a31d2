// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/passed_metadata.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "proto/types/metadata_keys.h"
#include "server/auth/fleet_key.h"
#include "server/auth/tickets.h"
#include "server/grpc/relay/owner_unreachable.h"
#include "server/grpc/status_conversion.h"

namespace dhpmap {
namespace {

constexpr std::string_view kUserAgent = "user-agent", kPassedUserAgent = "x-user-agent";
constexpr std::size_t kMostAgentBytes = 256;
constexpr std::size_t kFieldBytes = 32;  // that HTTP/2 counts for a field beside its text

bool IsLegalKey(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  });
}

bool IsLegalValue(std::string_view key, std::string_view value) {
  constexpr char kFirstPrintable = 0x20, kLastPrintable = 0x7e;
  return key.ends_with("-bin") ||
         std::all_of(value.begin(), value.end(), [](char c) { return c >= kFirstPrintable && c <= kLastPrintable; });
}

bool StaysHere(std::string_view key) {
  static constexpr std::array<std::string_view, 10> kKeys = {
      "authorization",     "cookie",    "host",      "te", "content-type", auth::kTicketKey, auth::kFleetKeyKey,
      auth::kPrincipalKey, kRelayedKey, kRouteMapKey};
  return key.starts_with("grpc-") || key.starts_with(":") || key == kUserAgent ||
         std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

template <typename Metadata, typename Add>
void Pass(const Metadata& metadata, const Add& add) {
  for (const auto& [key, value] : metadata) {
    const std::string_view name(key.data(), key.size()), text(value.data(), value.size());
    if (PassesOn(name, text)) add(std::string(name), std::string(text));
  }
}

}  // namespace

bool PassesOn(std::string_view key, std::string_view value) {
  return !StaysHere(key) && IsLegalKey(key) && IsLegalValue(key, value);
}

Status PassRequestHead(const grpc::CallbackServerContext& from, grpc::ClientContext& to) {
  const auto& metadata = from.client_metadata();
  std::size_t num_bytes = 0;
  Pass(metadata, [&](const std::string& key, const std::string& value) {
    num_bytes += key.size() + value.size() + kFieldBytes;
    if (num_bytes <= kMostPassedBytes) to.AddMetadata(key, value);
  });
  if (num_bytes > kMostPassedBytes) {
    return ResourceExhausted("the metadata of the call exceed the " + std::to_string(kMostPassedBytes) +
                             " bytes that one server passes on to another");
  }
  const auto agent = metadata.find(grpc::string_ref(kUserAgent.data(), kUserAgent.size()));
  const bool has_passed = metadata.contains(grpc::string_ref(kPassedUserAgent.data(), kPassedUserAgent.size()));
  if (agent != metadata.end() && !has_passed) {
    const std::string text(agent->second.data(), std::min(agent->second.size(), kMostAgentBytes));
    if (PassesOn(kPassedUserAgent, text)) to.AddMetadata(std::string(kPassedUserAgent), text);
  }
  to.set_deadline(from.raw_deadline());
  return Status::Ok();
}

void PassAnswerHead(const grpc::ClientContext& from, grpc::CallbackServerContext& to) {
  Pass(from.GetServerInitialMetadata(), [&](std::string key, std::string value) { to.AddInitialMetadata(key, value); });
}

void PassAnswerEnd(const grpc::ClientContext& from, grpc::CallbackServerContext& to) {
  Pass(from.GetServerTrailingMetadata(),
       [&](std::string key, std::string value) { to.AddTrailingMetadata(key, value); });
}

bool IsConnectionsEnd(const grpc::Status& status) {
  if (!status.error_details().empty()) return false;
  const grpc::StatusCode code = status.error_code();
  // CANCELLED comes from an owner that ends. A client that cancels reads no status.
  if (code == grpc::UNAUTHENTICATED)
    return status.error_message().starts_with("BAD_CREDENTIAL");  // else the caller's key
  return code == grpc::CANCELLED || code == grpc::UNAVAILABLE;
}

grpc::Status AsOwnerEnded(const grpc::Status& status) {
  if (!IsConnectionsEnd(status)) return status;
  const bool is_unknown = status.error_code() == grpc::UNAUTHENTICATED;
  return ToGrpc(OwnerUnreachable(is_unknown ? "the server that writes the map does not know this one"
                                            : "the server that writes the map cannot be reached"));
}

}  // namespace dhpmap
