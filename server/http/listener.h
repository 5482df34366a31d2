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
  std::string address;                         ///< host:port (port 0: a free one), or unix:PATH
  std::vector<int> sockets = {};               ///< already listening, in place of `address`; owned by the listener
  std::shared_ptr<const net::TlsContext> tls;  ///< null: no TLS
  int max_connections = 1000;                  ///< with TLS or a unix: address; otherwise on_connection limits them
  std::function<void(std::string_view why)> on_refused;  ///< with these; from several threads; may be empty
  int num_threads = 1;
  std::chrono::duration<double> idle_timeout{60};  ///< of a connection, between requests
  std::chrono::duration<double> head_timeout{10};  ///< from the first byte of a request to the end of its head
};

struct ListenerEvents {
  /// Called on the new connection's sequence of execution.
  std::function<void(std::shared_ptr<Connection>)> on_connection;
  /// Called when descriptors run out while a connection waits: closes another connection; returns false if none can be
  /// closed.
  std::function<bool()> on_no_descriptors;
};

/// Accepts connections and runs them on its threads. Connections with TLS, of a unix: address or of inherited sockets
/// come through a net::Door. Thread-safe.
class Listener {
 public:
  /// UNAVAILABLE if the address cannot be bound; INVALID_ARGUMENT if it is malformed.
  static Result<std::unique_ptr<Listener>> Start(const ListenerOptions& options, ListenerEvents events);
  /// Stops at once. Connections and their objects must have been destroyed.
  ~Listener();

  [[nodiscard]] int port() const;  ///< 0 for a unix: address
  void StopAccepting();

 private:
  struct Impl;
  explicit Listener(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::http
