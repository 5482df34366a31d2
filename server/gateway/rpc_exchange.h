// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "server/http/exchange.h"

namespace dhpmap {
class ByteShare;
class Lane;
}  // namespace dhpmap

namespace dhpmap::gateway {

class RpcCaller;
class SharedAnswers;
struct RpcRequest;

/// What exchanges work with; outlives them.
struct RpcBackend {
  RpcCaller* caller;
  /// For making JSON of large messages and messages of large JSON, which takes milliseconds: neither the connections'
  /// thread nor gRPC's does it, so that what is small never waits for it.
  Lane* bulk;
  /// For streams of events; null: each makes its own.
  SharedAnswers* shared = nullptr;
  /// For large messages of what clients stream: frames do not wait for what others ask for. Null: `bulk`.
  Lane* frames = nullptr;
  /// For pages of the gateway's own that take a while, whatever the others have to do. Null: they are made at once.
  Lane* pages = nullptr;
};

/// More than that, in bytes, is large. What is small takes a fraction of a millisecond, less than another thread may
/// take to wake up.
inline constexpr std::size_t kMostQuickBytes = 16u << 10;

/// Both keep what they hold of bodies and answers within `share`: TOO_MANY_BYTES, 429, where it cannot grow.

/// Collects the body, makes one call, answers with its response.
std::shared_ptr<http::Exchange> MakeUnaryExchange(RpcRequest request, ByteShare share, RpcBackend backend,
                                                  std::shared_ptr<http::Responder> responder);

/// For streams in either direction: messages go to the RPC as they arrive, and answers to the client as they come; each
/// side waits for the other. Answers are NDJSON, length-delimited messages, or the parts of a file put together.
std::shared_ptr<http::Exchange> MakeStreamExchange(RpcRequest request, ByteShare share, RpcBackend backend,
                                                   std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
