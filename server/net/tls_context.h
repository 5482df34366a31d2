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

/// Whether clients must present certificates signed by TlsOptions::client_ca.
enum class ClientAuth { kNone, kOptional, kRequired };

/// "none", "optional" or "required"; INVALID_ARGUMENT otherwise.
Result<ClientAuth> ClientAuthFromName(const std::string& name);

/// PEM files.
struct TlsOptions {
  std::string cert;       ///< the server's certificate, then its chain
  std::string key;        ///< its private key; refused if others may read it
  std::string client_ca;  ///< CA of client certificates; empty: none
  ClientAuth client_auth = ClientAuth::kNone;
};

/// The protocol inside TLS (ALPN).
enum class Protocol { kHttp2, kHttp11 };

/// The TLS settings and certificate of both doors: TLS 1.2 and 1.3 with forward secrecy, X25519, P-256 and P-384.
/// Renegotiation, compression, tickets and early data are off: they cost a server more than a client, or outlive a
/// connection. Thread-safe.
class TlsContext {
 public:
  /// INVALID_ARGUMENT if a file is not PEM, the key does not match the certificate, or the certificate has expired;
  /// NOT_FOUND if a file cannot be read; FAILED_PRECONDITION if others may read the key.
  static Result<std::shared_ptr<TlsContext>> Load(const TlsOptions& options);
  ~TlsContext();

  /// Reads the files again. Returns an error, and changes nothing, if they are invalid. Open connections keep their
  /// settings.
  Status Reload() DHPMAP_EXCLUDES(mutex_);
  /// Reloads if a file has changed since the last try, or that failed; nothing if there is no new result.
  std::optional<Status> ReloadIfChanged() DHPMAP_EXCLUDES(mutex_);

  /// The server side of a new connection, ready for its handshake. Null if memory has run out.
  [[nodiscard]] SslSession NewSession(Protocol protocol) const DHPMAP_EXCLUDES(mutex_);
  /// "CN=robot-hall, expires Jan  1 00:00:00 2027 GMT".
  [[nodiscard]] std::string Describe() const DHPMAP_EXCLUDES(mutex_);

 private:
  using Context = std::shared_ptr<ssl_ctx_st>;

  explicit TlsContext(TlsOptions options) : options_(std::move(options)) {}
  /// Identifies the state of the files, to detect changes.
  [[nodiscard]] std::string Stamp() const;

  const TlsOptions options_;
  mutable Mutex mutex_;
  Context context_ DHPMAP_GUARDED_BY(mutex_);
  std::string tried_ DHPMAP_GUARDED_BY(mutex_);
  std::string failure_ DHPMAP_GUARDED_BY(mutex_);  ///< of the last try; empty: it succeeded
};

/// The first URI, else DNS name, of the verified client certificate; "" without one.
std::string CertificateName(ssl_st* session);

}  // namespace dhpmap::net
