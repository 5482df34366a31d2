// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/http/exchange.h"

namespace dhpmap::net {
class TlsContext;
}

namespace dhpmap::http {

struct ServerOptions {
  std::string address = "127.0.0.1:8080";                ///< host:port (port 0: a free one), or unix:PATH
  std::vector<int> sockets = {};                         ///< already listening, in place of `address`; owned by the
                                                         ///< server
  std::shared_ptr<const net::TlsContext> tls;            ///< null: no TLS
  std::function<void(std::string_view why)> on_refused;  ///< TLS refused a connection; from several threads; may be
                                                         ///< empty
  int num_threads = 1;
  std::vector<std::string> allowed_hosts;  ///< further host names of this server, without ports; see HostNames
  /// At the limit the connection that has been idle longest is closed; without an idle one, the new one gets 503.
  int max_connections = 1000;
  std::chrono::duration<double> idle_timeout{60};  ///< between requests
  std::chrono::duration<double> head_timeout{10};  ///< from the first byte of a request to the end of its head
};

/// HTTP/1.1 on one address, with one handler. When file descriptors run out, it closes idle connections for new ones;
/// one reserved descriptor lets it keep accepting. Thread-safe.
class Server {
 public:
  /// UNAVAILABLE if the address cannot be bound; INVALID_ARGUMENT if it is malformed. `handler` must outlive the
  /// server.
  static Result<std::unique_ptr<Server>> Start(const ServerOptions& options, const Handler& handler);
  /// Requires that Shutdown returned true, and that no exchange calls its responder any more.
  ~Server();

  [[nodiscard]] int port() const;  ///< 0 for a unix: address

  /// Refuses new requests, waits at most `grace` for running ones, then closes. False if a connection is still open
  /// seconds later. Tasks that exchanges post still run until the server is destroyed.
  bool Shutdown(std::chrono::duration<double> grace);

 private:
  struct Impl;
  explicit Server(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::http
