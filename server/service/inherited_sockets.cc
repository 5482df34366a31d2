// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/inherited_sockets.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>

#include "server/service/notifier.h"

namespace dhpmap::service {
namespace {

constexpr int kFirst = 3;  // first descriptor of the protocol
constexpr int kMost = 64;

/// Parses a decimal number that is the whole text; else -1.
int IntOf(std::string_view text) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : -1;
}

/// "a:b" -> {"a", "b"}.
std::vector<std::string> SplitByColon(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':') parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

std::string UnixName(const sockaddr_un& address, socklen_t size) {
  const std::size_t length = size - offsetof(sockaddr_un, sun_path);
  std::string name(address.sun_path, length);
  if (!name.empty() && name.front() == '\0') return "unix:@" + name.substr(1);
  return "unix:" + name.substr(0, name.find('\0'));
}

}  // namespace

Result<InheritedSockets> SocketsIn(const std::vector<std::string>& environment, int pid) {
  InheritedSockets sockets;
  const std::string count_text = ValueIn(environment, "LISTEN_FDS");
  if (count_text.empty() || IntOf(ValueIn(environment, "LISTEN_PID")) != pid) return sockets;
  const int count = IntOf(count_text);
  if (count < 0 || count > kMost) return InvalidArgument("LISTEN_FDS is '" + count_text + "', not 0 to 64");
  if (count == 0) return sockets;
  const std::vector<std::string> names = SplitByColon(ValueIn(environment, "LISTEN_FDNAMES"));
  if (names.size() != static_cast<std::size_t>(count)) {
    return InvalidArgument("LISTEN_FDNAMES does not name each of the " + count_text +
                           " sockets: call them grpc and rest");
  }
  for (int i = 0; i < count; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    if (name != "grpc" && name != "rest") {
      return InvalidArgument("there is no door for a socket named '" + name +
                             "': FileDescriptorName= of a socket unit is grpc or rest");
    }
    (name == "grpc" ? sockets.grpc : sockets.rest).push_back(kFirst + i);
  }
  return sockets;
}

Result<std::string> AddressOf(int socket) {
  int is_listening = 0, type = 0;
  socklen_t size = sizeof is_listening;
  const bool is_known = ::getsockopt(socket, SOL_SOCKET, SO_ACCEPTCONN, &is_listening, &size) == 0 &&
                        ::getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
  const std::string which = "the socket handed over as descriptor " + std::to_string(socket);
  if (!is_known || is_listening == 0 || type != SOCK_STREAM) {
    return InvalidArgument(which + " is no stream socket that listens");
  }
  sockaddr_storage name{};
  size = sizeof name;
  if (::getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size) != 0) {
    return InvalidArgument(which + " has no address");
  }
  std::array<char, INET6_ADDRSTRLEN> text{};
  switch (name.ss_family) {
    case AF_UNIX: return UnixName(reinterpret_cast<const sockaddr_un&>(name), size);
    case AF_INET: {
      const auto& address = reinterpret_cast<const sockaddr_in&>(name);
      ::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
      return std::string(text.data()) + ":" + std::to_string(ntohs(address.sin_port));
    }
    case AF_INET6: {
      const auto& address = reinterpret_cast<const sockaddr_in6&>(name);
      ::inet_ntop(AF_INET6, &address.sin6_addr, text.data(), text.size());
      return std::string("[").append(text.data()).append("]:").append(std::to_string(ntohs(address.sin6_port)));
    }
    default: return InvalidArgument(which + " is of no family of addresses that the doors know");
  }
}

Result<std::string> AddressOf(const std::vector<int>& sockets, bool (*is_loopback)(std::string_view address)) {
  std::string shown;
  for (const int socket : sockets) {
    DHPMAP_ASSIGN_OR_RETURN(std::string address, AddressOf(socket));
    if (shown.empty() || (is_loopback(shown) && !is_loopback(address))) shown = std::move(address);
  }
  return shown;
}

}  // namespace dhpmap::service
