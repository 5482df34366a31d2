// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace dhpmap::net {

/// The identity of a peer, as far as the connection itself proves it.
struct PeerIdentity {
  /// "192.0.2.7:41000", "[2001:db8::7]:41000"; "unix" for a unix: address.
  std::string address;
  /// For a unix: address: the user of the connected process, as the kernel reports it (SO_PEERCRED).
  std::optional<uid_t> uid;
  /// From the client certificate, if tls.client_ca has signed it: its first URI, else its first DNS name
  /// (subjectAltName; never the common name). Empty without a certificate.
  std::string certificate_name;
};

/// The key that limits count by: the IPv4 address, the first 64 bits of an IPv6 address, or the user of a local
/// process.
std::string PeerKey(const PeerIdentity& peer);

}  // namespace dhpmap::net
