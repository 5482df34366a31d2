// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::service {

/// Listening sockets that a service manager opened for the doors: sd_listen_fds_with_names(3). They may use addresses
/// that the server itself may not bind, and clients wait while the server restarts.
struct InheritedSockets {
  std::vector<int> grpc, rest;  ///< descriptors; the user takes ownership

  [[nodiscard]] bool empty() const { return grpc.empty() && rest.empty(); }
};

/// Reads LISTEN_PID, LISTEN_FDS and LISTEN_FDNAMES; nothing if they are for another process. INVALID_ARGUMENT if a
/// socket is not named "grpc" or "rest", or the variables contradict each other.
Result<InheritedSockets> SocketsIn(const std::vector<std::string>& environment, int pid);

/// Where the socket listens: "127.0.0.1:8080", "[::]:8080" or "unix:PATH". INVALID_ARGUMENT if it is not a stream
/// socket that listens at such an address.
Result<std::string> AddressOf(int socket);
/// Of several sockets: an address that other machines can reach, else the first. Must not be empty.
Result<std::string> AddressOf(const std::vector<int>& sockets, bool (*is_loopback)(std::string_view address));

}  // namespace dhpmap::service
