// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tests/unit/server/net/test_certificates.h"

namespace dhpmap::testing {

struct TlsClientOptions {
  std::string ca;  ///< PEM; empty: any certificate will do
  const CertificateFiles* own = nullptr;
  std::string protocol = "h2";              ///< empty: offers none
  int least_version = 0, most_version = 0;  ///< TLS1_2_VERSION; 0: OpenSSL's
  std::string groups, ciphers;              ///< of TLS 1.2 ciphers; empty: OpenSSL's
};

/// A blocking client of TLS on one connection to 127.0.0.1. Reading and sending end after kPatience.
class TlsClient {
 public:
  TlsClient(int port, const TlsClientOptions& options);
  ~TlsClient();
  TlsClient(const TlsClient&) = delete;
  TlsClient& operator=(const TlsClient&) = delete;

  /// Whether the handshake came to its end.
  [[nodiscard]] bool is_connected() const;
  /// OpenSSL's words, such as "tlsv1 alert protocol version".
  [[nodiscard]] const std::string& error() const;
  [[nodiscard]] std::string protocol() const;     ///< that was agreed on
  [[nodiscard]] std::string common_name() const;  ///< of the server's certificate
  bool Send(std::string_view bytes);
  /// At least one byte; "" at the end.
  std::string Read();
  /// `num_bytes` bytes, or fewer at the end.
  std::string ReadExactly(std::size_t num_bytes);
  /// Whether the server agrees to a new handshake on this connection, or a new key.
  bool Renegotiate();
  /// Sends `count` key updates, one after the other.
  void UpdateKeys(int count);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::testing
