// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace dhpmap::testing {

struct CertificateFiles {
  std::string cert, key;
};

struct CertificateWish {
  std::string common_name = "localhost";
  /// "DNS:localhost,IP:127.0.0.1", "URI:robot://hall/7"
  std::string alt_names = "DNS:localhost,IP:127.0.0.1";
  bool is_expired = false;
  const CertificateFiles* signed_by = nullptr;  ///< null: by itself, and may sign others
};

/// Makes a key of P-256 (0600) and a certificate, as NAME.key and NAME.crt in the folder. Ends the test program if
/// OpenSSL cannot.
CertificateFiles MakeCertificate(const std::filesystem::path& folder, const std::string& name,
                                 const CertificateWish& wish = {});

}  // namespace dhpmap::testing
