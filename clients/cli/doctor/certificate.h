// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace dhpmap {

/// What a client sees of a server's TLS.
struct CertificateSight {
  bool is_reached = false;        ///< somebody listens there
  bool is_tls = false;            ///< and speaks TLS
  std::string fault;              ///< why the certificate is not to be trusted, in OpenSSL's words; empty: it is
  bool is_expired = false;        ///< that it is so
  bool is_of_other_name = false;  ///< or for another host
  std::int64_t expires_s = 0;     ///< UTC, since 1970
};

/// Connects to "host:port" and looks at the certificate; `ca` is a PEM file of whom to trust, "system" for those that
/// this system trusts, or empty: nobody. Takes 5 s at most a step.
CertificateSight LookAtCertificate(const std::string& address, const std::string& ca);

}  // namespace dhpmap
