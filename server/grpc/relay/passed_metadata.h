// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/server_context.h>

#include "mapping/base/status.h"

namespace dhpmap {

// What passes through a server that passes a call on.

/// The client's metadata and deadline: all but gRPC's own, its credentials, and what only servers say.
void PassRequestHead(const grpc::CallbackServerContext& from, grpc::ClientContext& to);
/// The answer's initial metadata, before its first message.
void PassAnswerHead(const grpc::ClientContext& from, grpc::CallbackServerContext& to);
/// The answer's trailing metadata.
void PassAnswerEnd(const grpc::ClientContext& from, grpc::CallbackServerContext& to);

/// What a client is told of an end that came from no handler of the owner, which would say why: UNAVAILABLE, reason
/// OWNER_UNREACHABLE, to be tried again. Other ends as they are.
grpc::Status AsOwnerEnded(const grpc::Status& status);

}  // namespace dhpmap
