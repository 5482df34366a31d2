// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/make_upstream.h"

#include <utility>

#include "proto/types/metadata_keys.h"
#include "server/auth/fleet_key.h"
#include "server/auth/tickets.h"
#include "server/grpc/relay/passed_metadata.h"

namespace dhpmap {
namespace {

/// A ticket proves to this server that it has checked the caller already.
Result<std::shared_ptr<UpstreamCall>> MakeUpstreamHere(Relay& relay, const grpc::CallbackServerContext& call,
                                                       const auth::PrincipalPtr& principal,
                                                       std::shared_ptr<UpstreamListener> listener) {
  auto upstream = std::make_shared<UpstreamCall>(std::move(listener), relay.Here());
  DHPMAP_RETURN_IF_ERROR(PassRequestHead(call, upstream->context()));
  const auto ticket = relay.gate().tickets().Issue(principal);
  upstream->context().AddMetadata(auth::kTicketKey, ticket->text());
  upstream->context().AddMetadata(kRelayedKey, kPassedHere);
  upstream->Keep(ticket);
  return upstream;
}

}  // namespace

Result<std::shared_ptr<UpstreamCall>> MakeUpstream(Relay& relay, const grpc::CallbackServerContext& call,
                                                   const auth::PrincipalPtr& principal, const Route& route,
                                                   std::shared_ptr<UpstreamListener> listener) {
  if (route.way == Route::Way::kHere) return MakeUpstreamHere(relay, call, principal, std::move(listener));
  DHPMAP_ASSIGN_OR_RETURN(auto channel, relay.ChannelTo(route.owner->address));
  auto upstream = std::make_shared<UpstreamCall>(std::move(listener), std::move(channel));
  grpc::ClientContext& context = upstream->context();
  DHPMAP_RETURN_IF_ERROR(PassRequestHead(call, context));
  context.AddMetadata(kRelayedKey, kPassedOn);
  context.AddMetadata(kRouteMapKey, route.map);
  const auth::Gate& gate = relay.gate();
  if (const auth::FleetKey* key = gate.fleet_key()) context.AddMetadata(auth::kFleetKeyKey, key->text());
  if (gate.has_keys()) context.AddMetadata(auth::kPrincipalKey, auth::TextOf(*principal));
  return upstream;
}

}  // namespace dhpmap
