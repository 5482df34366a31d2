// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/net/client_socket.h"
#include "server/net/peer_identity.h"
#include "server/net/peer_table.h"
#include "server/net/refusal.h"

namespace dhpmap::net {

/// A connection that has completed handshake and preface.
struct Greeted {
  ClientSocket socket;
  PeerIdentity peer;
  std::shared_ptr<PeerCounts> counts;
  std::string local_address;  ///< that it connected to, without the port; empty for a unix: address
};

struct GreeterOptions {
  Protocol protocol = Protocol::kHttp2;
  std::shared_ptr<const TlsContext> tls;  ///< null: no TLS
  /// For the handshake and the preface together.
  std::chrono::milliseconds within{5'000};
  std::size_t max_new = 256;          ///< limit of pending ones; beyond it the oldest of the peer with most is closed
  std::size_t max_new_per_peer = 64;  ///< likewise
};

/// Completes the TLS handshake of new connections, then reads and removes the HTTP/2 preface. Runs on its own thread:
/// handshakes do not delay established connections. A silent connection costs one descriptor until its deadline.
/// Thread-safe.
class Greeter {
 public:
  struct Events {
    std::function<void(Greeted)> on_greeted;
    std::function<void(Refusal, const PeerIdentity&)> on_refused;
  };
  Greeter(const GreeterOptions& options, Events events);
  /// Closes the pending connections.
  ~Greeter();

  /// Takes a connected, non-blocking socket.
  void Add(Descriptor socket, PeerIdentity peer, std::shared_ptr<PeerCounts> counts);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
