// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::service {

/// Sockets that listen already, which a service manager has opened for the doors and hands to this process:
/// sd_listen_fds_with_names(3). So it may listen where the server must not, and keeps who connects waiting while the
/// server starts again.
struct InheritedSockets {
  std::vector<int> grpc, rest;  ///< descriptors, whose owner is whoever takes them

  [[nodiscard]] bool empty() const { return grpc.empty() && rest.empty(); }
};

/// What LISTEN_PID, LISTEN_FDS and LISTEN_FDNAMES of the environment say; nothing if they are for another process.
/// INVALID_ARGUMENT if a socket has another name than "grpc" or "rest", or the variables contradict each other.
Result<InheritedSockets> SocketsIn(const std::vector<std::string>& environment, int pid);

/// Where it listens: "127.0.0.1:8080", "[::]:8080" or "unix:PATH". INVALID_ARGUMENT if it is no stream socket that
/// listens at such an address.
Result<std::string> AddressOf(int socket);
/// Of several: one that other machines can reach, if there is any, else the first. They are not empty.
Result<std::string> AddressOf(const std::vector<int>& sockets, bool (*is_loopback)(std::string_view address));

}  // namespace dhpmap::service
