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

/// Hands connections to gRPC. With keys it uses one acceptor per slot, so that wrong keys are counted by address.
/// Thread-safe once the server has been built.
class Entrance {
 public:
  /// Adds its acceptors to the server's builder.
  Entrance(const std::shared_ptr<auth::Gate>& gate, grpc::ServerBuilder& builder);

  void Let(const net::Passed& passed) DHPMAP_EXCLUDES(mutex_);
  /// Call it before the server shuts down: gRPC (1.51) leaks sockets that it receives after that.
  void Close() DHPMAP_EXCLUDES(mutex_);

 private:
  using Acceptor = grpc::experimental::ExternalConnectionAcceptor;

  const std::shared_ptr<PeerSlots> slots_ = std::make_shared<PeerSlots>();
  std::vector<std::unique_ptr<Acceptor>> acceptors_;  ///< one, or one per slot
  Mutex mutex_;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap
