// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server_builder.h>

#include <memory>
#include <vector>

#include "mapping/base/mutex.h"
#include "server/auth/gate.h"
#include "server/grpc/peer_slots.h"

namespace dhpmap {
namespace net {
struct Passed;
}

/// Hands connections to gRPC: with keys through an acceptor a slot, so that wrong keys are counted by address.
/// Thread-safe, once the server has been built.
class Entrance {
 public:
  /// Adds what it needs to the builder of the server.
  Entrance(const std::shared_ptr<auth::Gate>& gate, grpc::ServerBuilder& builder);

  void Let(const net::Passed& passed) DHPMAP_EXCLUDES(mutex_);
  /// To be called before the server is shut down: gRPC (1.51) leaves sockets open that it gets after that.
  void Close() DHPMAP_EXCLUDES(mutex_);

 private:
  using Acceptor = grpc::experimental::ExternalConnectionAcceptor;

  const std::shared_ptr<PeerSlots> slots_ = std::make_shared<PeerSlots>();
  std::vector<std::unique_ptr<Acceptor>> acceptors_;  ///< one, or by slot
  Mutex mutex_;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap
