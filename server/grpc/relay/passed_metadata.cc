// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/passed_metadata.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "proto/types/metadata_keys.h"
#include "server/auth/fleet_key.h"
#include "server/auth/tickets.h"
#include "server/grpc/status_conversion.h"
#include "server/log/log.h"

namespace dhpmap {
namespace {

constexpr std::string_view kUserAgent = "user-agent", kPassedUserAgent = "x-user-agent";

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
    const std::string_view name(key.data(), key.size());
    if (!StaysHere(name)) add(std::string(name), std::string(value.data(), value.size()));
  }
}

Status Unreachable(std::string message) {
  return Unavailable(std::move(message)).WithReason("OWNER_UNREACHABLE").WithMetadata("retry_after_s", "1");
}

}  // namespace

void PassRequestHead(const grpc::CallbackServerContext& from, grpc::ClientContext& to) {
  const auto& metadata = from.client_metadata();
  Pass(metadata, [&](std::string key, std::string value) { to.AddMetadata(key, value); });
  const auto agent = metadata.find(grpc::string_ref(kUserAgent.data(), kUserAgent.size()));
  const bool has_passed = metadata.contains(grpc::string_ref(kPassedUserAgent.data(), kPassedUserAgent.size()));
  if (agent != metadata.end() && !has_passed) {
    to.AddMetadata(std::string(kPassedUserAgent), std::string(agent->second.data(), agent->second.size()));
  }
  to.set_deadline(from.raw_deadline());
}

void PassAnswerHead(const grpc::ClientContext& from, grpc::CallbackServerContext& to) {
  Pass(from.GetServerInitialMetadata(), [&](std::string key, std::string value) { to.AddInitialMetadata(key, value); });
}

void PassAnswerEnd(const grpc::ClientContext& from, grpc::CallbackServerContext& to) {
  Pass(from.GetServerTrailingMetadata(),
       [&](std::string key, std::string value) { to.AddTrailingMetadata(key, value); });
}

grpc::Status AsOwnerEnded(const grpc::Status& status) {
  if (!status.error_details().empty()) return status;
  switch (status.error_code()) {
    case grpc::CANCELLED:  // by the owner, which ends: a client that cancels reads no status
    case grpc::UNAVAILABLE: return ToGrpc(Unreachable("the server that writes the map cannot be reached"));
    case grpc::UNAUTHENTICATED:
      LogError("another server of the fleet takes no calls from this one: " + status.error_message());
      return ToGrpc(Unreachable("the server that writes the map does not know this one"));
    default: return status;
  }
}

}  // namespace dhpmap
