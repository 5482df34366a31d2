// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "server/http/exchange.h"

namespace dhpmap {
class ByteShare;
}

namespace dhpmap::gateway {

class RpcCaller;
struct RpcRequest;

/// Both keep what they hold of bodies and answers within `share`: TOO_MANY_BYTES, 429, where it cannot grow.

/// Collects the body, makes one call, answers with its response.
std::shared_ptr<http::Exchange> MakeUnaryExchange(RpcRequest request, ByteShare share, RpcCaller* caller,
                                                  std::shared_ptr<http::Responder> responder);

/// For streams in either direction: messages go to the RPC as they arrive, and answers to the client as they come; each
/// side waits for the other. Answers are NDJSON, length-delimited messages, or the parts of a file put together.
std::shared_ptr<http::Exchange> MakeStreamExchange(RpcRequest request, ByteShare share, RpcCaller* caller,
                                                   std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
