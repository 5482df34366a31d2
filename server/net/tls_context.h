// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"

struct ssl_st;
struct ssl_ctx_st;

namespace dhpmap::net {

struct SslFree {
  void operator()(ssl_st* session) const;
  void operator()(ssl_ctx_st* context) const;
};
using SslSession = std::unique_ptr<ssl_st, SslFree>;

/// Whether clients show certificates, signed by TlsOptions::client_ca.
enum class ClientAuth { kNone, kOptional, kRequired };

/// "none", "optional" or "required"; INVALID_ARGUMENT otherwise.
Result<ClientAuth> ClientAuthFromName(const std::string& name);

/// Files in PEM.
struct TlsOptions {
  std::string cert;       ///< the server's certificate, then those that have signed it
  std::string key;        ///< its private key; readable by others it is refused
  std::string client_ca;  ///< who signs clients' certificates; empty: nobody
  ClientAuth client_auth = ClientAuth::kNone;
};

/// What a door speaks inside of TLS (ALPN).
enum class Protocol { kHttp2, kHttp11 };

/// The certificate of both doors: TLS 1.2 and 1.3, forward secrecy, X25519, P-256 and P-384, and nothing that costs a
/// server more than a client or outlives a connection (no renegotiation, compression, tickets, early data).
/// Thread-safe.
class TlsContext {
 public:
  /// INVALID_ARGUMENT if a file is no PEM, the key is not the certificate's, or that has expired; NOT_FOUND if one
  /// cannot be read; FAILED_PRECONDITION for a key that others may read.
  static Result<std::shared_ptr<TlsContext>> Load(const TlsOptions& options);
  ~TlsContext();

  /// Reads the files again. What cannot be used changes nothing, and is said. Connections go on with what they began
  /// with.
  Status Reload() DHPMAP_EXCLUDES(mutex_);
  /// Reload if a file is another than at the last try, or that failed; nothing where there is nothing new to say.
  std::optional<Status> ReloadIfChanged() DHPMAP_EXCLUDES(mutex_);

  /// Of a new connection: the server's side, ready for its handshake. Null if there is no memory.
  [[nodiscard]] SslSession NewSession(Protocol protocol) const DHPMAP_EXCLUDES(mutex_);
  /// "CN=robot-hall, expires Jan  1 00:00:00 2027 GMT".
  [[nodiscard]] std::string Describe() const DHPMAP_EXCLUDES(mutex_);

 private:
  using Context = std::shared_ptr<ssl_ctx_st>;

  explicit TlsContext(TlsOptions options) : options_(std::move(options)) {}
  /// Of the files: what changes when they do.
  [[nodiscard]] std::string Stamp() const;

  const TlsOptions options_;
  mutable Mutex mutex_;
  Context context_ DHPMAP_GUARDED_BY(mutex_);
  std::string tried_ DHPMAP_GUARDED_BY(mutex_);
  std::string failure_ DHPMAP_GUARDED_BY(mutex_);  ///< of that try; empty: it did not fail
};

/// The first URI or else DNS name of the certificate that the client has shown and that was verified; "" if there is
/// none.
std::string CertificateName(ssl_st* session);

}  // namespace dhpmap::net
