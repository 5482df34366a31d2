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

/// What exchanges use; must outlive them.
struct RpcBackend {
  RpcCaller* caller;
  /// Converts large messages to and from JSON, which takes milliseconds. Neither the connections' thread nor gRPC's
  /// does it, so that small requests do not wait for it.
  Lane* bulk;
  /// For event streams; null: each stream makes its own messages.
  SharedAnswers* shared = nullptr;
  /// For large messages of client streams, so that frames do not wait for other calls. Null: `bulk`.
  Lane* frames = nullptr;
  /// For slow pages of the gateway, independent of the other work. Null: they are made at once.
  Lane* pages = nullptr;
};

/// Size in bytes above which a message is large. Smaller ones take a fraction of a millisecond, less than another
/// thread may take to wake up.
inline constexpr std::size_t kMostQuickBytes = 16u << 10;

/// Both keep the bytes of bodies and answers within `share`: TOO_MANY_BYTES, 429, when it cannot grow.

/// Collects the body, makes one call, answers with its response.
std::shared_ptr<http::Exchange> MakeUnaryExchange(RpcRequest request, ByteShare share, RpcBackend backend,
                                                  std::shared_ptr<http::Responder> responder);

/// For streams in either direction. Forwards messages to the RPC and answers to the client as they arrive, with
/// back-pressure both ways. Answers are NDJSON, length-delimited messages, or the parts of a file put together.
std::shared_ptr<http::Exchange> MakeStreamExchange(RpcRequest request, ByteShare share, RpcBackend backend,
                                                   std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
