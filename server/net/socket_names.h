// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "server/net/peer_identity.h"

namespace dhpmap::net {

/// Of a connected socket: its peer's address, or user behind a unix: address. No certificate yet.
PeerIdentity IdentityOf(int socket);

/// The address that the peer has connected to, without the port: "127.0.0.1", "::1"; "" behind a unix: address.
std::string LocalAddress(int socket);

}  // namespace dhpmap::net
