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
  std::string address;            ///< host:port (port 0: a free one), or unix:PATH
  std::vector<int> sockets = {};  ///< already listening, in place of `address`; owned by the door
  int max_connections = 1000;
  Protocol protocol = Protocol::kHttp2;     ///< for kHttp2, frames are counted
  std::shared_ptr<const TlsContext> tls;    ///< null: no TLS
  int num_relays = 2;                       ///< threads that forward bytes
  std::function<void(Refusal)> on_refused;  ///< for metrics; from several threads; may be empty
};

/// A connection as the server behind the door receives it: a local socket that carries the decrypted bytes.
struct Passed {
  int socket = -1;  ///< owned by the receiver; non-blocking
  PeerIdentity peer;
  std::string local_address;  ///< that the client connected to, without the port; empty for a unix: address
};

/// Accepts connections, terminates TLS, counts HTTP/2 frames, and forwards bytes to a server that needs to know none of
/// this. Ends connections that exceed FrameLimits, with a line in the log. Memory per connection is bounded: if one
/// side does not read, the door stops reading from the other. Thread-safe, except Start.
class Door {
 public:
  /// Listens; connections wait until Start. Errors as ConnectionAcceptor::Listen: INVALID_ARGUMENT, UNAVAILABLE.
  static Result<std::unique_ptr<Door>> Open(const DoorOptions& options);
  /// Stops accepting. Flushes the server's last bytes to clients for up to a second. The server should have closed its
  /// sockets before.
  ~Door();

  /// 0 behind a unix: address.
  [[nodiscard]] int port() const;
  /// `take` runs on a thread of the door. Called once.
  void Start(std::function<void(Passed)> take);
  /// Stops accepting; open connections continue.
  void StopAccepting();

  /// The peer of the connection whose other end has this name, as in grpc::ServerContext::peer(). Nothing if the
  /// connection is not of this door or has ended.
  [[nodiscard]] std::optional<PeerIdentity> Find(std::string_view peer) const;
  [[nodiscard]] std::size_t num_connections() const;  ///< past handshake and preface

 private:
  struct Impl;
  explicit Door(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
