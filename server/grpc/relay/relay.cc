// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/relay.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <utility>

#include "proto/types/metadata_keys.h"
#include "server/auth/fleet_key.h"
#include "server/auth/tickets.h"
#include "server/grpc/answered_anywhere.h"
#include "server/grpc/relay/passed_metadata.h"

namespace dhpmap {
namespace {

using Way = Route::Way;

Status NoDatabase() {
  return Unavailable("this server has not reached its database for so long that another one may write its maps")
      .WithReason("DATABASE_UNREACHABLE")
      .WithMetadata("retry_after_s", "1");
}

}  // namespace

std::string OwnerText(const MapOwner& owner) { return owner.address + ' ' + std::to_string(owner.epoch); }

Status NotOwner(const MapOwner& owner) {
  return Unavailable("another server writes the map").WithReason("NOT_OWNER").WithMetadata("owner", owner.address);
}

std::string_view MetadataOf(const grpc::CallbackServerContext& call, const char* key) {
  const auto& metadata = call.client_metadata();
  const auto found = metadata.find(key);
  if (found == metadata.end()) return {};
  return {found->second.data(), found->second.size()};
}

Relay::Relay(const ServiceContext& context) : context_(context), peers_(context.options.peer_tls) {}

std::shared_ptr<const RelayedMethod> Relay::MethodOf(const auth::CallNeeds* needs,
                                                     const google::protobuf::Descriptor& request, std::string path,
                                                     std::size_t most_bytes) {
  const auto* prototype = google::protobuf::MessageFactory::generated_factory()->GetPrototype(&request);
  if (needs == nullptr || AnsweredAnywhere(*prototype)) return nullptr;
  RouteFields fields(*needs, request);
  if (fields.empty()) return nullptr;
  return std::make_shared<const RelayedMethod>(RelayedMethod{needs, std::move(fields), std::move(path), most_bytes});
}

Route Relay::RouteOf(const RelayedMethod& method, const grpc::CallbackServerContext& call,
                     const grpc::ByteBuffer* first) const {
  const std::string_view mark = MetadataOf(call, kRelayedKey);
  if (mark == kPassedHere && !MetadataOf(call, auth::kTicketKey).empty()) return {};
  const bool is_passed_on = !mark.empty();
  if (is_passed_on || !MetadataOf(call, auth::kFleetKeyKey).empty()) {
    Status refusal = CheckPassedOn(call);
    if (!refusal.ok()) return {.way = Way::kRefuse, .refusal = std::move(refusal)};
  }
  RouteFields::Found found;
  if (first != nullptr) found = method.fields.In(*first);
  else found.map = MetadataOf(call, kRouteMapKey);
  if (found.is_eventual) return {};
  if (!found.map.empty()) return RouteTo(std::move(found.map), is_passed_on);
  // Of a request without a map the handler says what is wrong.
  return {.way = first != nullptr ? Way::kHere : Way::kAsk, .is_passed_on = is_passed_on};
}

Route Relay::RouteTo(std::string map, bool is_passed_on) const {
  const auto owner = fleet().KnownOwner(map);
  // Who passed the call on may have asked the database later than this server has.
  const bool is_doubtful = owner && !owner->is_me && is_passed_on;
  if (!owner || is_doubtful) return {.way = Way::kAsk, .is_passed_on = is_passed_on, .map = std::move(map)};
  return RouteFor(std::move(map), is_passed_on, *owner);
}

Route Relay::AskFor(std::string map, bool is_passed_on) const {
  auto owner = fleet().OwnerOf(map);
  // The handler says it better, with names that are much the same.
  if (owner.status().code() == StatusCode::kNotFound) return {.map = std::move(map)};
  if (!owner.ok()) return {.way = Way::kRefuse, .map = std::move(map), .refusal = owner.status()};
  return RouteFor(std::move(map), is_passed_on, *owner);
}

Route Relay::RouteFor(std::string map, bool is_passed_on, const MapOwner& owner) const {
  Route route{.is_passed_on = is_passed_on, .map = std::move(map), .owner = owner};
  if (owner.is_me && !fleet().MayAnswer()) route.refusal = NoDatabase();
  if (!owner.is_me && (is_passed_on || !CanPassOn())) route.refusal = NotOwner(owner);
  route.way = !route.refusal.ok() ? Way::kRefuse : owner.is_me ? Way::kHere : Way::kOn;
  return route;
}

Result<std::shared_ptr<grpc::Channel>> Relay::ChannelTo(const std::string& address) {
  auto channel = peers_.Get(address);
  if (channel.status().code() == StatusCode::kUnavailable) {
    troubles_.Note(address, channel.status().ToString());
  }
  return channel;
}

void Relay::NoteEnd(const std::string& address, const grpc::Status& status) {
  if (IsConnectionsEnd(status)) troubles_.Note(address, status.error_message());
}

bool Relay::CanPassOn() const { return !gate().has_keys() || gate().fleet_key() != nullptr; }

/// What only servers say is believed of servers only.
Status Relay::CheckPassedOn(const grpc::CallbackServerContext& call) const {
  const auth::FleetKey* key = gate().fleet_key();
  if (key == nullptr && !gate().has_keys()) return Status::Ok();  // whoever comes may do everything
  if (key != nullptr && key->Is(MetadataOf(call, auth::kFleetKeyKey))) return Status::Ok();
  return Status(StatusCode::kUnauthenticated, "a call that says that a server passes it on shows no good fleet key")
      .WithReason("BAD_CREDENTIAL");
}

void Relay::SetHere(std::shared_ptr<grpc::Channel> here) {
  const MutexLock lock(mutex_);
  here_ = std::move(here);
}

std::shared_ptr<grpc::Channel> Relay::Here() const {
  const MutexLock lock(mutex_);
  return here_;
}

}  // namespace dhpmap
