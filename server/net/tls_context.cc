// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/tls_context.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <utility>

#include "server/net/tls_files.h"

namespace dhpmap::net {
namespace {

constexpr char kCiphersOf12[] = "ECDHE+AESGCM:ECDHE+CHACHA20";
/// OpenSSL's default includes groups that cost the server much more than the client.
constexpr char kGroups[] = "X25519:P-256:P-384";
/// One system call may read several records.
constexpr std::size_t kReadAhead_bytes = 64u << 10;

/// ALPN names. A session's app data points to one of them.
constexpr std::array<unsigned char, 3> kHttp2Name = {2, 'h', '2'};
constexpr std::array<unsigned char, 9> kHttp11Name = {8, 'h', 't', 't', 'p', '/', '1', '.', '1'};

int SelectProtocol(SSL* session, const unsigned char** selected, unsigned char* selected_bytes,
                   const unsigned char* offered, unsigned int offered_bytes, void* /*unused*/) {
  const auto* name = static_cast<const unsigned char*>(SSL_get_app_data(session));
  unsigned char* found = nullptr;
  const int result = SSL_select_next_proto(&found, selected_bytes, name, 1u + name[0], offered, offered_bytes);
  *selected = found;
  return result == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_ALERT_FATAL;
}

void Harden(SSL_CTX* context) {
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(context, kCiphersOf12);
  SSL_CTX_set1_groups_list(context, kGroups);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_NO_TICKET |
                                   SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_PRIORITIZE_CHACHA);
  SSL_CTX_set_num_tickets(context, 0);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_max_early_data(context, 0);
  SSL_CTX_set_mode(context,
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_read_ahead(context, 1);
  SSL_CTX_set_default_read_buffer_len(context, kReadAhead_bytes);
  SSL_CTX_set_alpn_select_cb(context, SelectProtocol, nullptr);
}

Status UseClientCa(SSL_CTX* context, const TlsOptions& options) {
  if (options.client_auth == ClientAuth::kNone) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(const Certificates authorities, ReadCertificates(options.client_ca));
  for (const auto& authority : authorities) {
    X509_STORE_add_cert(SSL_CTX_get_cert_store(context), authority.get());
    SSL_CTX_add_client_CA(context, authority.get());
  }
  const int required = options.client_auth == ClientAuth::kRequired ? SSL_VERIFY_FAIL_IF_NO_PEER_CERT : 0;
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER | required, nullptr);
  return Status::Ok();
}

Status UsePair(SSL_CTX* context, const TlsOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Certificates chain, ReadCertificates(options.cert));
  DHPMAP_ASSIGN_OR_RETURN(const PrivateKey key, ReadPrivateKey(options.key));
  if (X509_cmp_current_time(X509_get0_notAfter(chain.front().get())) <= 0) {
    return InvalidArgument("the certificate in " + options.cert + " has expired");
  }
  if (X509_check_private_key(chain.front().get(), key.get()) != 1) {
    ERR_clear_error();
    return InvalidArgument("the key in " + options.key + " is not that of the certificate in " + options.cert);
  }
  bool is_used = SSL_CTX_use_certificate(context, chain.front().get()) == 1;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    is_used = is_used && SSL_CTX_add1_chain_cert(context, chain[i].get()) == 1;
  }
  is_used = is_used && SSL_CTX_use_PrivateKey(context, key.get()) == 1;
  ERR_clear_error();
  return is_used ? Status::Ok() : InvalidArgument("the certificate in " + options.cert + " is too weak to be used");
}

/// OpenSSL 3.0 processes any number of KeyUpdates within one SSL_read, which might never return. Honest clients change
/// keys once in hundreds of gigabytes.
void CountKeyUpdates(int is_written, int, int content, const void* message, std::size_t size, SSL* session, void*) {
  constexpr std::uintptr_t kMost = 64;
  static const int place = SSL_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
  const bool is_key_update = is_written == 0 && content == SSL3_RT_HANDSHAKE && size > 0 &&
                             *static_cast<const unsigned char*>(message) == SSL3_MT_KEY_UPDATE;
  if (!is_key_update || place < 0) return;
  const auto count = reinterpret_cast<std::uintptr_t>(SSL_get_ex_data(session, place)) + 1;
  SSL_set_ex_data(session, place, reinterpret_cast<void*>(count));
  if (count > kMost) ::shutdown(SSL_get_fd(session), SHUT_RDWR);  // makes the next read fail
}

Result<std::shared_ptr<SSL_CTX>> Make(const TlsOptions& options) {
  std::shared_ptr<SSL_CTX> context(SSL_CTX_new(TLS_server_method()), SslFree());
  if (context == nullptr) return ResourceExhausted("no memory for TLS");
  Harden(context.get());
  SSL_CTX_set_msg_callback(context.get(), CountKeyUpdates);
  DHPMAP_RETURN_IF_ERROR(UsePair(context.get(), options));
  DHPMAP_RETURN_IF_ERROR(UseClientCa(context.get(), options));
  return context;
}

std::string TextOf(BIO* out) {
  char* data = nullptr;
  const auto size = BIO_get_mem_data(out, &data);
  return {data, static_cast<std::size_t>(size)};
}

}  // namespace

void SslFree::operator()(ssl_st* session) const { SSL_free(session); }
void SslFree::operator()(ssl_ctx_st* context) const { SSL_CTX_free(context); }

Result<ClientAuth> ClientAuthFromName(const std::string& name) {
  if (name == "none") return ClientAuth::kNone;
  if (name == "optional") return ClientAuth::kOptional;
  if (name == "required") return ClientAuth::kRequired;
  return InvalidArgument("'" + name + "' is not none, optional or required");
}

Result<std::shared_ptr<TlsContext>> TlsContext::Load(const TlsOptions& options) {
  std::shared_ptr<TlsContext> tls(new TlsContext(options));
  DHPMAP_RETURN_IF_ERROR(tls->Reload());
  return tls;
}

TlsContext::~TlsContext() = default;

Status TlsContext::Reload() {
  std::string stamp = Stamp();  // taken before, so that a change during the reload is read next time
  auto made = Make(options_);
  const MutexLock lock(mutex_);
  tried_ = std::move(stamp);
  failure_ = made.ok() ? std::string() : made.status().message();
  if (!made.ok()) return made.status();
  context_ = std::move(*made);
  return Status::Ok();
}

std::optional<Status> TlsContext::ReloadIfChanged() {
  std::string told;
  {
    const std::string stamp = Stamp();
    const MutexLock lock(mutex_);
    if (stamp == tried_ && failure_.empty()) return std::nullopt;
    if (stamp == tried_) told = failure_;  // it may have failed for another reason, such as descriptors
  }
  Status status = Reload();
  if (!status.ok() && status.message() == told) return std::nullopt;
  return status;
}

std::string TlsContext::Stamp() const {
  std::string stamp;
  for (const std::string& path : {options_.cert, options_.key, options_.client_ca}) {
    struct stat found {};
    if (path.empty() || ::stat(path.c_str(), &found) != 0) {
      stamp += "-;";
      continue;
    }
    for (const auto number : {static_cast<long long>(found.st_ino), static_cast<long long>(found.st_size),
                              static_cast<long long>(found.st_mtim.tv_sec),
                              static_cast<long long>(found.st_mtim.tv_nsec), static_cast<long long>(found.st_mode)}) {
      stamp += std::to_string(number) + ",";
    }
  }
  return stamp;
}

SslSession TlsContext::NewSession(Protocol protocol) const {
  Context context;
  {
    const MutexLock lock(mutex_);
    context = context_;
  }
  SslSession session(SSL_new(context.get()));
  if (session == nullptr) return session;
  const unsigned char* name = protocol == Protocol::kHttp2 ? kHttp2Name.data() : kHttp11Name.data();
  SSL_set_app_data(session.get(), const_cast<unsigned char*>(name));
  SSL_set_accept_state(session.get());
  return session;
}

std::string TlsContext::Describe() const {
  Context context;
  {
    const MutexLock lock(mutex_);
    context = context_;
  }
  const X509* certificate = SSL_CTX_get0_certificate(context.get());
  const std::unique_ptr<BIO, int (*)(BIO*)> out(BIO_new(BIO_s_mem()), BIO_free);
  X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate), 0, XN_FLAG_ONELINE & ~ASN1_STRFLGS_ESC_MSB);
  BIO_puts(out.get(), ", expires ");
  ASN1_TIME_print(out.get(), X509_get0_notAfter(certificate));
  return TextOf(out.get());
}

std::string CertificateName(ssl_st* session) {
  const X509* certificate = SSL_get0_peer_certificate(session);
  if (certificate == nullptr || SSL_get_verify_result(session) != X509_V_OK) return "";
  const std::unique_ptr<GENERAL_NAMES, void (*)(GENERAL_NAMES*)> names(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)),
      GENERAL_NAMES_free);
  for (const int kind : {GEN_URI, GEN_DNS}) {
    for (int i = 0; names != nullptr && i < sk_GENERAL_NAME_num(names.get()); ++i) {
      const GENERAL_NAME* name = sk_GENERAL_NAME_value(names.get(), i);
      if (name->type != kind) continue;
      const ASN1_IA5STRING* text = kind == GEN_URI ? name->d.uniformResourceIdentifier : name->d.dNSName;
      return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
              static_cast<std::size_t>(ASN1_STRING_length(text))};
    }
  }
  return "";
}

}  // namespace dhpmap::net
