// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::net {

struct AcceptorOptions {
  std::string address;            ///< host:port, also a name; port 0 takes a free one; or unix:PATH
  std::vector<int> sockets = {};  ///< that listen already, in its place; then the acceptor's
  /// Of those handed over and still open. Those beyond it are accepted and closed at once: a client that is refused
  /// knows more than one that waits.
  int max_connections = 1000;
};

/// Accepts connections on a thread of its own and hands them over. Goes on when there are no file descriptors left:
/// one is kept back, with which those that come then are refused; and does not take the last ones, so that others find
/// some. Not thread-safe.
class ConnectionAcceptor {
 public:
  /// Listens as net::ListenOn does, or ListenOnInherited. Connections wait until Start. INVALID_ARGUMENT if it is no
  /// address, UNAVAILABLE if it cannot be listened on.
  static Result<std::unique_ptr<ConnectionAcceptor>> Listen(const AcceptorOptions& options);
  /// Stops.
  ~ConnectionAcceptor();

  [[nodiscard]] int port() const;  ///< 0 of a unix: address
  /// `take` becomes the owner of each connected socket, which does not block and is not inherited by children. It runs
  /// on the thread. Called once.
  void Start(std::function<void(int socket)> take);
  /// Accepts no more; `take` has returned and is not called again. What was handed over goes on.
  void Stop();

 private:
  struct Impl;
  explicit ConnectionAcceptor(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
