// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/server_context.h>

#include <cstddef>
#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap {

// What passes through a server that passes a call on.

/// What a call may bring along. A server takes 8 KiB, and the caller's rights need room beside it: beyond that it would
/// refuse the call in gRPC's words, or end the connection, on which others call too.
inline constexpr std::size_t kMostPassedBytes = 4096;

/// The client's metadata and deadline: all but gRPC's own, its credentials, and what only servers say.
/// RESOURCE_EXHAUSTED if these are more than kMostPassedBytes, 32 for each field included.
Status PassRequestHead(const grpc::CallbackServerContext& from, grpc::ClientContext& to);
/// The answer's initial metadata, before its first message.
void PassAnswerHead(const grpc::ClientContext& from, grpc::CallbackServerContext& to);
/// The answer's trailing metadata.
void PassAnswerEnd(const grpc::ClientContext& from, grpc::CallbackServerContext& to);

/// Whether one field of metadata is passed on. Not passed: what gRPC, servers and credentials use, and what gRPC's
/// client cannot send. gRPC's server takes any bytes from the network, but its client ends the process over a field
/// that is not of the form that gRPC prescribes.
bool PassesOn(std::string_view key, std::string_view value);

/// Whether a call ended before a handler of the owner could say why: no connection, a lost one, or a fleet key that the
/// owner does not know.
bool IsConnectionsEnd(const grpc::Status& status);
/// Such an end as the client gets it: UNAVAILABLE, reason OWNER_UNREACHABLE, with RetryInfo. Other ends as they are.
grpc::Status AsOwnerEnded(const grpc::Status& status);

}  // namespace dhpmap
