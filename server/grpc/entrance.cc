// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/entrance.h"

#include <grpc/grpc_security_constants.h>
#include <unistd.h>

#include "server/grpc/door_credentials.h"
#include "server/net/door.h"
#include "server/net/peer_identity.h"

namespace dhpmap {

Entrance::Entrance(const std::shared_ptr<auth::Gate>& gate, grpc::ServerBuilder& builder) {
  const std::size_t num = gate->has_keys() ? PeerSlots::kNum : 1;
  for (std::size_t slot = 0; slot < num; ++slot) {
    const auto from = [slots = slots_, slot] { return slots->KeyOf(slot); };
    acceptors_.push_back(builder.experimental().AddExternalConnectionAcceptor(
        grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, MakeDoorCredentials(gate, UDS, from)));
  }
}

void Entrance::Let(const net::Passed& passed) {
  const bool has_address = !passed.peer.uid && acceptors_.size() > 1;
  const std::size_t slot = has_address ? slots_->Of(net::PeerKey(passed.peer)) : 0;
  Acceptor::NewConnectionParameters connection;
  connection.fd = passed.socket;
  const MutexLock lock(mutex_);
  if (is_closed_) {
    ::close(passed.socket);
  } else {
    acceptors_[slot]->HandleNewConnection(&connection);
  }
}

void Entrance::Close() {
  const MutexLock lock(mutex_);
  is_closed_ = true;
}

}  // namespace dhpmap
