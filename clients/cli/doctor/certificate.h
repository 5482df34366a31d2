// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace dhpmap {

/// A server's TLS as a client sees it.
struct CertificateSight {
  bool is_reached = false;        ///< a server listens there
  bool is_tls = false;            ///< it speaks TLS
  std::string fault;              ///< why the certificate is not trusted, as OpenSSL reports it; empty: it is trusted
  bool is_expired = false;        ///< the reason is expiry
  bool is_of_other_name = false;  ///< the reason is another host name
  std::int64_t expires_s = 0;     ///< UTC, since 1970
};

/// Connects to "host:port" and checks the certificate. `ca`: a PEM file of trusted CAs, "system" for those of this
/// system, or empty for none. Takes at most 5 s a step.
CertificateSight LookAtCertificate(const std::string& address, const std::string& ca);

}  // namespace dhpmap
