// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/socket_names.h"

#include <netdb.h>
#include <sys/socket.h>

#include <array>

namespace dhpmap::net {
namespace {

struct Endpoint {
  std::string host, port;
  bool is_v6 = false;
};

using NameGetter = int (*)(int, sockaddr*, socklen_t*) noexcept;

/// Empty unless the socket is TCP.
Endpoint EndpointOf(int socket, NameGetter get_name) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  auto* address = reinterpret_cast<sockaddr*>(&name);
  if (get_name(socket, address, &size) != 0 || (name.ss_family != AF_INET && name.ss_family != AF_INET6)) return {};
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (::getnameinfo(address, size, host.data(), host.size(), port.data(), port.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return {};
  }
  Endpoint found{.host = host.data(), .port = port.data(), .is_v6 = name.ss_family == AF_INET6};
  constexpr std::string_view kMapped = "::ffff:";  // an IPv4 client of a dual-stack socket
  if (found.is_v6 && found.host.starts_with(kMapped) && found.host.find('.') != std::string::npos) {
    found = {.host = found.host.substr(kMapped.size()), .port = found.port};
  }
  return found;
}

}  // namespace

PeerIdentity IdentityOf(int socket) {
  const Endpoint peer = EndpointOf(socket, ::getpeername);
  if (!peer.host.empty()) {
    return {.address = (peer.is_v6 ? "[" + peer.host + "]" : peer.host) + ":" + peer.port};
  }
  PeerIdentity identity{.address = "unix"};
  ucred credentials{};
  socklen_t size = sizeof credentials;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0) identity.uid = credentials.uid;
  return identity;
}

std::string LocalAddress(int socket) { return EndpointOf(socket, ::getsockname).host; }

}  // namespace dhpmap::net
