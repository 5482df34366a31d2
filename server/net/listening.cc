// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/listening.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "server/net/address.h"

namespace dhpmap::net {
namespace {

constexpr std::string_view kUnix = "unix:";
constexpr mode_t kOwnerAndGroup = 0660;

bool Set(const Descriptor& socket, int level, int option, int value) {
  return ::setsockopt(socket.get(), level, option, &value, sizeof value) == 0;
}

/// Accepted sockets inherit these options. They detect a dead peer or network after 25 s of silence.
void KeepAlive(const Descriptor& socket) {
  Set(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  Set(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  Set(socket, IPPROTO_TCP, TCP_KEEPIDLE, 10);
  Set(socket, IPPROTO_TCP, TCP_KEEPINTVL, 5);
  Set(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

/// Whether an IPv6 socket should accept IPv4, too: only the wildcard address.
bool IsForBothFamilies(const addrinfo& address) {
  return address.ai_family == AF_INET6 &&
         IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6*>(address.ai_addr)->sin6_addr);
}

/// On failure the result is empty, and errno has the reason.
Descriptor ListenOnOne(const addrinfo& address, bool is_alone) {
  Descriptor socket(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.get() < 0) return socket;
  Set(socket, SOL_SOCKET, SO_REUSEADDR, 1);
  KeepAlive(socket);
  if (address.ai_family == AF_INET6) {
    Set(socket, IPPROTO_IPV6, IPV6_V6ONLY, is_alone && IsForBothFamilies(address) ? 0 : 1);
  }
  if (::bind(socket.get(), address.ai_addr, address.ai_addrlen) != 0 || ::listen(socket.get(), SOMAXCONN) != 0) {
    const int error = errno;
    socket = Descriptor();
    errno = error;
  }
  return socket;
}

int PortOf(const Descriptor& socket) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  if (::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&name), &size) != 0) return 0;
  if (name.ss_family == AF_UNIX) return 0;
  return ntohs(name.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(name).sin6_port
                                          : reinterpret_cast<const sockaddr_in&>(name).sin_port);
}

Result<Listening> ListenOnHost(const std::string& text) {
  DHPMAP_ASSIGN_OR_RETURN(const Address address, SplitAddress(text));
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address.port);
  const int no_host =
      ::getaddrinfo(address.host.empty() ? nullptr : address.host.c_str(), port.c_str(), &hints, &found);
  if (no_host != 0) return InvalidArgument("'" + text + "' is no address: " + ::gai_strerror(no_host));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, ::freeaddrinfo);
  std::vector<Descriptor> sockets;
  int error = 0;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Descriptor socket = ListenOnOne(*one, found->ai_next == nullptr);
    if (socket.get() >= 0) {
      sockets.push_back(std::move(socket));
      if (address.port == 0) break;
    } else if (error = errno; error == EADDRINUSE) {  // on any: another server would get clients
      break;
    }
  }
  if (sockets.empty() || error == EADDRINUSE) {
    return Unavailable("cannot listen on " + text + ": " + std::strerror(error));
  }
  const int taken_port = PortOf(sockets.front());
  return Listening{.sockets = std::move(sockets), .port = taken_port};
}

/// Whether the file is the socket of a server that has ended: nobody listens.
bool IsDeadSocket(const std::string& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0 || !S_ISSOCK(found.st_mode)) return false;
  const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const bool is_answered =
      ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 || errno == EAGAIN;
  return !is_answered && errno == ECONNREFUSED;
}

Result<Listening> ListenOnPath(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    return InvalidArgument("'unix:" + path + "' is no address: a path of at most " +
                           std::to_string(sizeof address.sun_path - 1) + " characters is");
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  if (IsDeadSocket(path, address)) ::unlink(path.c_str());
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const bool is_listening = socket.get() >= 0 &&
                            ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
                            ::chmod(path.c_str(), kOwnerAndGroup) == 0 &&  // before anybody can connect
                            ::listen(socket.get(), SOMAXCONN) == 0;
  if (!is_listening) return Unavailable("cannot listen on unix:" + path + ": " + std::strerror(errno));
  Listening listening{.path = path};
  listening.sockets.push_back(std::move(socket));
  return listening;
}

}  // namespace

Result<Listening> ListenOn(const std::string& address) {
  return address.starts_with(kUnix) ? ListenOnPath(address.substr(kUnix.size())) : ListenOnHost(address);
}

Result<Listening> ListenOnInherited(const std::vector<int>& sockets) {
  Listening listening;
  for (const int descriptor : sockets) {
    Descriptor socket(descriptor);
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags < 0 || ::fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) != 0 ||
        ::fcntl(descriptor, F_SETFD, FD_CLOEXEC) != 0) {
      return Unavailable(std::string("cannot listen on a socket that was handed over: ") + std::strerror(errno));
    }
    KeepAlive(socket);
    listening.sockets.push_back(std::move(socket));
  }
  listening.port = PortOf(listening.sockets.front());
  return listening;
}

}  // namespace dhpmap::net
