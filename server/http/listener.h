// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/http/connection.h"

namespace dhpmap::net {
class TlsContext;
}

namespace dhpmap::http {

struct ListenerOptions {
  std::string address;                         ///< host:port, port 0 takes a free one; or unix:PATH
  std::vector<int> sockets = {};               ///< that listen already, in its place; then the listener's
  std::shared_ptr<const net::TlsContext> tls;  ///< null: in the clear
  int max_connections = 1000;                  ///< behind TLS or a unix: address; others are for who hears of them
  std::function<void(std::string_view why)> on_refused;  ///< there; from several threads; may be empty
  int num_threads = 1;
  std::chrono::duration<double> idle_timeout{60};  ///< of a connection, between requests
  std::chrono::duration<double> head_timeout{10};  ///< from the first byte of a request to the end of its head
};

struct ListenerEvents {
  /// Runs on the new connection's sequence of execution.
  std::function<void(std::shared_ptr<Connection>)> on_connection;
  /// A connection waits that cannot be accepted: closes another, and returns whether there was one to close.
  std::function<bool()> on_no_descriptors;
};

/// Accepts connections and runs them on its threads. Those with TLS, of a unix: address or of
/// sockets that were handed over come through a net::Door.
/// Thread-safe.
class Listener {
 public:
  /// UNAVAILABLE if "host:port" cannot be bound; INVALID_ARGUMENT if it is no address.
  static Result<std::unique_ptr<Listener>> Start(const ListenerOptions& options, ListenerEvents events);
  /// Stops at once. Connections and what they hold must be gone.
  ~Listener();

  [[nodiscard]] int port() const;  ///< 0 of a unix: address
  void StopAccepting();

 private:
  struct Impl;
  explicit Listener(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::http
