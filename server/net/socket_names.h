// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "server/net/peer_identity.h"

namespace dhpmap::net {

/// The peer of a connected socket: its address, or its user for a unix: address. Without a certificate.
PeerIdentity IdentityOf(int socket);

/// The address that the peer connected to, without the port: "127.0.0.1", "::1"; "" for a unix: address.
std::string LocalAddress(int socket);

}  // namespace dhpmap::net
