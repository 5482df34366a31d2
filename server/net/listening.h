// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "server/net/descriptor.h"

namespace dhpmap::net {

/// Sockets that listen, do not block, and are not inherited by children.
struct Listening {
  std::vector<Descriptor> sockets;  ///< at least one
  int port = 0;                     ///< 0 of a unix: address
  std::string path;                 ///< of a unix: address: the file, to be removed when nobody listens any more
};

/// host:port, on all addresses that the host has, on a free port (0) only on the first; or unix:PATH, a socket that
/// its owner and group may connect to (0660). There, the socket of a server that has gone is replaced, no other file.
/// INVALID_ARGUMENT if it is no address, UNAVAILABLE if it cannot be listened on.
Result<Listening> ListenOn(const std::string& address);

/// On sockets that listen already, at one port or path: they are ours from here on. A file that one of them has is its
/// maker's. UNAVAILABLE if one is no socket.
Result<Listening> ListenOnInherited(const std::vector<int>& sockets);

}  // namespace dhpmap::net
