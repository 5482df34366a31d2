// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace dhpmap::net {

/// Who is at the other end of a connection, as far as the connection itself proves it.
struct PeerIdentity {
  /// "192.0.2.7:41000", "[2001:db8::7]:41000"; "unix" behind a unix: address.
  std::string address;
  /// Behind a unix: address: the user of the process that has connected, as the kernel says (SO_PEERCRED).
  std::optional<uid_t> uid;
  /// Of the certificate that the client has shown and tls.client_ca has signed: its first URI, else its first DNS
  /// name (subjectAltName; never the common name). Empty without a certificate.
  std::string certificate_name;
};

/// What counts as one peer for limits: the IPv4 address, the first 64 bits of an IPv6 one, or the user of a process of
/// this machine.
std::string PeerKey(const PeerIdentity& peer);

}  // namespace dhpmap::net
