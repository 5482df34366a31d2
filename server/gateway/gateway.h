// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/base/byte_budget.h"
#include "server/gateway/hooks.h"

namespace grpc {
class Channel;
}

namespace dhpmap {
namespace net {
class TlsContext;
}

struct GatewayOptions {
  std::string address = "127.0.0.1:8080";                ///< host:port (port 0: a free one), or unix:PATH
  std::vector<int> sockets = {};                         ///< already listening, in place of `address`; owned by the
                                                         ///< door
  std::shared_ptr<const net::TlsContext> tls;            ///< null: no TLS
  std::function<void(std::string_view why)> on_refused;  ///< TLS refused a connection; from several threads; may be
                                                         ///< empty
  std::size_t max_body_bytes = 64u << 20;                ///< larger bodies are answered with 413
  /// For bodies and answers in memory. Requests beyond it are answered with 429. Never null.
  std::shared_ptr<ByteBudget> inflight = std::make_shared<ByteBudget>(256u << 20);
  int num_threads = 1;
  std::vector<std::string> allowed_hosts;    ///< host names to accept, besides its address and localhost
  std::vector<std::string> allowed_origins;  ///< whose pages may use the API with a key; see AllowedOrigins
  int max_connections = 1000;
  double idle_timeout_s = 60;  ///< of a connection between requests
  double head_timeout_s = 10;  ///< from the first byte of a request to the end of its head
};

/// The REST door: transcodes every RPC with a google.api.http annotation by its descriptors, and calls it over an
/// in-process channel, so that both doors run the same handlers. Thread-safe.
class Gateway {
 public:
  /// Binds and serves until Shutdown or destruction. UNAVAILABLE if the address cannot be bound.
  static Result<std::unique_ptr<Gateway>> Start(const GatewayOptions& options, std::shared_ptr<grpc::Channel> channel,
                                                GatewayHooks hooks);
  ~Gateway();

  [[nodiscard]] int port() const;
  /// Refuses new requests, waits at most `grace_s` for running ones, then closes.
  void Shutdown(double grace_s = 2.0);

 private:
  struct Impl;
  explicit Gateway(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
