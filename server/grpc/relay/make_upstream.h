// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server_context.h>

#include <memory>

#include "server/auth/gate.h"
#include "server/grpc/relay/relay.h"
#include "server/grpc/relay/upstream_call.h"

namespace dhpmap {

/// The upstream call for `call`, which `principal` makes: to the owner that `route` names (Way::kOn), or to this server
/// (Way::kHere). With deadline and metadata, not yet started. UNAVAILABLE, reason OWNER_UNREACHABLE, if the files for
/// TLS cannot be read; RESOURCE_EXHAUSTED, reason TOO_BUSY, as of PeerChannels::Get.
Result<std::shared_ptr<UpstreamCall>> MakeUpstream(Relay& relay, const grpc::CallbackServerContext& call,
                                                   const auth::PrincipalPtr& principal, const Route& route,
                                                   std::shared_ptr<UpstreamListener> listener);

}  // namespace dhpmap
