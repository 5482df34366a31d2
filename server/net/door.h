// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/net/peer_identity.h"
#include "server/net/refusal.h"
#include "server/net/tls_context.h"

namespace dhpmap::net {

struct DoorOptions {
  std::string name;               ///< for the log: "gRPC"
  std::string address;            ///< host:port, port 0 takes a free one; or unix:PATH
  std::vector<int> sockets = {};  ///< that listen already, in its place; then the door's
  int max_connections = 1000;
  Protocol protocol = Protocol::kHttp2;     ///< of kHttp2, frames are counted
  std::shared_ptr<const TlsContext> tls;    ///< null: in the clear
  int num_relays = 2;                       ///< threads that pass bytes
  std::function<void(Refusal)> on_refused;  ///< for metrics; from several threads; may be empty
};

/// A connection as the server behind the door gets it: a socket of this machine that carries what is inside of TLS.
struct Passed {
  int socket = -1;  ///< now its owner's; does not block
  PeerIdentity peer;
  std::string local_address;  ///< that the client has connected to, without the port; empty behind a unix: address
};

/// Accepts connections, ends TLS, counts HTTP/2 frames, and passes bytes to a server that need know nothing of these.
/// Ends a connection that does what no client has to (FrameLimits), with a line in the log. Memory a connection is
/// bounded, and who does not read is not read from. Thread-safe, but for Start.
class Door {
 public:
  /// Listens; connections wait until Start. INVALID_ARGUMENT, UNAVAILABLE as ConnectionAcceptor::Listen.
  static Result<std::unique_ptr<Door>> Open(const DoorOptions& options);
  /// Accepts no more; what the server has said last still goes to its clients, for a second. The server should have
  /// closed its sockets.
  ~Door();

  /// 0 behind a unix: address.
  [[nodiscard]] int port() const;
  /// `take` runs on a thread of the door. Called once.
  void Start(std::function<void(Passed)> take);
  /// Accepts no more; connections that are open go on.
  void StopAccepting();

  /// Whose connection has the other end with this name, as grpc::ServerContext::peer() tells it. Nothing if it is none
  /// of this door, or has ended.
  [[nodiscard]] std::optional<PeerIdentity> Find(std::string_view peer) const;
  [[nodiscard]] std::size_t num_connections() const;  ///< that are through

 private:
  struct Impl;
  explicit Door(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
