// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/server/net/tls_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <array>
#include <chrono>

#include "server/net/descriptor.h"
#include "server/net/pipe_signal.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

net::Descriptor Connect(int port) {
  net::Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const timeval timeout{.tv_sec = std::chrono::seconds(kPatience).count(), .tv_usec = 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  (void)::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  return socket;
}

void Configure(SSL_CTX* context, const TlsClientOptions& options) {
  SSL_CTX_set_security_level(context, 0);
  SSL_CTX_set_min_proto_version(context, options.least_version);
  SSL_CTX_set_max_proto_version(context, options.most_version);
  if (!options.groups.empty()) SSL_CTX_set1_groups_list(context, options.groups.c_str());
  if (!options.ciphers.empty()) SSL_CTX_set_cipher_list(context, options.ciphers.c_str());
  if (!options.ca.empty()) {
    SSL_CTX_load_verify_file(context, options.ca.c_str());
    SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  }
  if (options.own != nullptr) {
    SSL_CTX_use_certificate_chain_file(context, options.own->cert.c_str());
    SSL_CTX_use_PrivateKey_file(context, options.own->key.c_str(), SSL_FILETYPE_PEM);
  }
  if (!options.protocol.empty()) {
    const std::string list = static_cast<char>(options.protocol.size()) + options.protocol;
    SSL_CTX_set_alpn_protos(context, reinterpret_cast<const unsigned char*>(list.data()),
                            static_cast<unsigned int>(list.size()));
  }
}

}  // namespace

struct TlsClient::Impl {
  net::Descriptor socket;
  std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context{SSL_CTX_new(TLS_client_method()), SSL_CTX_free};
  std::unique_ptr<SSL, decltype(&SSL_free)> session{nullptr, SSL_free};
  bool is_connected = false;
  std::string error;

  void NoteError() {
    std::array<char, 256> text{};
    ERR_error_string_n(ERR_peek_last_error(), text.data(), text.size());
    error = text.data();
    ERR_clear_error();
  }
};

TlsClient::TlsClient(int port, const TlsClientOptions& options) : impl_(std::make_unique<Impl>()) {
  net::BlockPipeSignal();
  Configure(impl_->context.get(), options);
  impl_->socket = Connect(port);
  impl_->session.reset(SSL_new(impl_->context.get()));
  SSL_set_fd(impl_->session.get(), impl_->socket.get());
  impl_->is_connected = SSL_connect(impl_->session.get()) == 1;
  if (!impl_->is_connected) impl_->NoteError();
}

TlsClient::~TlsClient() {
  if (impl_->is_connected) SSL_shutdown(impl_->session.get());
}

bool TlsClient::is_connected() const { return impl_->is_connected; }
const std::string& TlsClient::error() const { return impl_->error; }

std::string TlsClient::protocol() const {
  const unsigned char* name = nullptr;
  unsigned int num_bytes = 0;
  SSL_get0_alpn_selected(impl_->session.get(), &name, &num_bytes);
  return {reinterpret_cast<const char*>(name), num_bytes};
}

std::string TlsClient::common_name() const {
  const X509* certificate = SSL_get0_peer_certificate(impl_->session.get());
  if (certificate == nullptr) return "";
  std::array<char, 256> name{};
  X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, name.data(), name.size());
  return name.data();
}

bool TlsClient::Send(std::string_view bytes) {
  std::size_t num_sent = 0;
  return SSL_write_ex(impl_->session.get(), bytes.data(), bytes.size(), &num_sent) == 1;
}

std::string TlsClient::Read() {
  std::string bytes(65'536, '\0');
  std::size_t num_read = 0;
  if (SSL_read_ex(impl_->session.get(), bytes.data(), bytes.size(), &num_read) != 1) impl_->NoteError();
  bytes.resize(num_read);
  return bytes;
}

std::string TlsClient::ReadExactly(std::size_t num_bytes) {
  std::string bytes;
  while (bytes.size() < num_bytes) {
    const std::string more = Read();
    if (more.empty()) break;
    bytes += more;
  }
  return bytes;
}

bool TlsClient::Renegotiate() {
  if (SSL_renegotiate(impl_->session.get()) != 1) return false;
  const bool is_agreed = SSL_do_handshake(impl_->session.get()) == 1;
  if (!is_agreed) impl_->NoteError();
  return is_agreed;
}

void TlsClient::UpdateKeys(int count) {
  for (int i = 0; i < count; ++i) {
    (void)SSL_key_update(impl_->session.get(), SSL_KEY_UPDATE_NOT_REQUESTED);
    if (SSL_do_handshake(impl_->session.get()) != 1) return;
  }
}

}  // namespace dhpmap::testing
