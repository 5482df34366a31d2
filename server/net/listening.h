// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "server/net/descriptor.h"

namespace dhpmap::net {

/// Listening sockets: non-blocking, close-on-exec.
struct Listening {
  std::vector<Descriptor> sockets;  ///< at least one
  int port = 0;                     ///< 0 for a unix: address
  std::string path;                 ///< file of a unix: address, to be removed when listening ends
};

/// Listens at host:port, on all addresses of the host (for a free port, 0, only on the first), or at unix:PATH, with
/// access for owner and group (0660). Replaces the socket file of a server that has ended, but no other file.
/// INVALID_ARGUMENT for a malformed address, UNAVAILABLE if listening fails.
Result<Listening> ListenOn(const std::string& address);

/// Takes ownership of sockets that already listen, at one port or path. The file of a unix: socket remains its
/// creator's. UNAVAILABLE if one is not a socket.
Result<Listening> ListenOnInherited(const std::vector<int>& sockets);

}  // namespace dhpmap::net
