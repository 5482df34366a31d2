// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/peer_identity.h"

#include <arpa/inet.h>

#include <array>
#include <cstring>

namespace dhpmap::net {
namespace {

/// The /64 prefix: the holder of one IPv6 address usually has 2^64 of them.
std::string NetworkOf(const std::string& host) {
  in6_addr address{};
  if (::inet_pton(AF_INET6, host.substr(0, host.find('%')).c_str(), &address) != 1) return host;
  if (IN6_IS_ADDR_V4MAPPED(&address)) {
    std::array<char, INET_ADDRSTRLEN> text{};
    return ::inet_ntop(AF_INET, &address.s6_addr[12], text.data(), text.size());
  }
  std::memset(&address.s6_addr[8], 0, 8);
  std::array<char, INET6_ADDRSTRLEN> text{};
  return std::string(::inet_ntop(AF_INET6, &address, text.data(), text.size())) + "/64";
}

}  // namespace

std::string PeerKey(const PeerIdentity& peer) {
  if (peer.uid) return "uid " + std::to_string(*peer.uid);
  std::string host = peer.address.substr(0, peer.address.rfind(':'));
  if (host.size() > 1 && host.front() == '[') host = host.substr(1, host.size() - 2);
  return NetworkOf(host);
}

}  // namespace dhpmap::net
