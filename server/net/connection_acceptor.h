// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::net {

struct AcceptorOptions {
  std::string address;            ///< host:port (host may be a name; port 0: a free one), or unix:PATH
  std::vector<int> sockets = {};  ///< already listening, in place of `address`; owned by the acceptor
  /// Limit of connections that were handed over and are still open. Further ones are accepted and closed at once,
  /// because a refusal tells the client more than waiting.
  int max_connections = 1000;
};

/// Accepts connections on its own thread and hands them over. When file descriptors run out, it uses a reserved one to
/// refuse new connections. It leaves the last descriptors to others. Not thread-safe.
class ConnectionAcceptor {
 public:
  /// Listens like net::ListenOn or ListenOnInherited. Connections wait until Start. INVALID_ARGUMENT for a malformed
  /// address, UNAVAILABLE if listening fails.
  static Result<std::unique_ptr<ConnectionAcceptor>> Listen(const AcceptorOptions& options);
  /// Stops.
  ~ConnectionAcceptor();

  [[nodiscard]] int port() const;  ///< 0 for a unix: address
  /// `take` gets ownership of each connected socket: non-blocking, close-on-exec. It runs on the acceptor's thread.
  /// Call once.
  void Start(std::function<void(int socket)> take);
  /// Stops accepting; `take` has returned and is not called again. Connections that were handed over continue.
  void Stop();

 private:
  struct Impl;
  explicit ConnectionAcceptor(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
