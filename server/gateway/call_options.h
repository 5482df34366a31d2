// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/result.h"
#include "server/gateway/rpc_call.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

/// The RPC's metadata and deadline from the request's headers. Passes on authorization, traceparent, tracestate,
/// user-agent (as x-user-agent) and x-request-id (generated if missing). `grpc-timeout: 500m` or `X-Timeout-S: 0.5`
/// sets the deadline. INVALID_ARGUMENT for a malformed timeout, or a value that gRPC cannot carry.
Result<CallOptions> MakeCallOptions(const std::string& rpc_path, const http::Headers& headers);

/// The request id in `options`.
const std::string& RequestIdOf(const CallOptions& options);

}  // namespace dhpmap::gateway
