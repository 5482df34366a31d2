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
  std::string address = "127.0.0.1:8080";                ///< host:port, port 0 takes a free one; or unix:PATH
  std::vector<int> sockets = {};                         ///< that listen already, in its place; then the server's
  std::shared_ptr<const net::TlsContext> tls;            ///< null: in the clear
  std::function<void(std::string_view why)> on_refused;  ///< by TLS; from several threads; may be empty
  int num_threads = 1;
  std::vector<std::string> allowed_hosts;  ///< further names of this server, without ports; see HostNames
  /// Beyond it the connection that has been idle longest is closed, or else the new one answered with 503.
  int max_connections = 1000;
  std::chrono::duration<double> idle_timeout{60};  ///< between requests
  std::chrono::duration<double> head_timeout{10};  ///< from the first byte of a request to the end of its head
};

/// HTTP/1.1 on one address: every request goes to one handler. When file descriptors run out, idle connections are
/// closed for new ones, and one descriptor is kept back, so that it goes on answering. Thread-safe.
class Server {
 public:
  /// UNAVAILABLE if the address cannot be bound; INVALID_ARGUMENT if it is none. `handler` outlives the server.
  static Result<std::unique_ptr<Server>> Start(const ServerOptions& options, const Handler& handler);
  /// Only after a Shutdown that returned true, and when no exchange will call its responder any more.
  ~Server();

  [[nodiscard]] int port() const;  ///< 0 of a unix: address

  /// Refuses new requests, lets running ones end for at most `grace`, then closes. False if some connection is still
  /// open seconds later. What exchanges post still runs, until the server is destroyed.
  bool Shutdown(std::chrono::duration<double> grace);

 private:
  struct Impl;
  explicit Server(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::http
