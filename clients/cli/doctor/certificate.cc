// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/doctor/certificate.h"

#include <netdb.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <memory>

namespace dhpmap {
namespace {

constexpr timeval kLongestStep{.tv_sec = 5, .tv_usec = 0};

struct Place {
  std::string host, port;
};

/// Parses "host:port" and "[v6]:port".
std::optional<Place> PlaceOf(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (address.starts_with("unix:") || colon == std::string::npos) return std::nullopt;
  Place place{.host = address.substr(0, colon), .port = address.substr(colon + 1)};
  if (place.host.starts_with('[') && place.host.ends_with(']'))
    place.host = place.host.substr(1, place.host.size() - 2);
  return place;
}

/// Returns a connected socket, or -1. SO_SNDTIMEO limits connect, too.
int ConnectTo(const Place& place) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(place.host.c_str(), place.port.c_str(), &hints, &found) != 0) return -1;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, ::freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    const int socket = ::socket(one->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) continue;
    for (const int option : {SO_SNDTIMEO, SO_RCVTIMEO}) {
      (void)::setsockopt(socket, SOL_SOCKET, option, &kLongestStep, sizeof kLongestStep);
    }
    if (::connect(socket, one->ai_addr, one->ai_addrlen) == 0) return socket;
    ::close(socket);
  }
  return -1;
}

using TlsSettings = std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)>;
using TlsSession = std::unique_ptr<SSL, void (*)(SSL*)>;

TlsSettings SettingsFor(const std::string& ca) {
  TlsSettings context(SSL_CTX_new(TLS_client_method()), SSL_CTX_free);
  if (context == nullptr) return context;
  if (ca == "system") SSL_CTX_set_default_verify_paths(context.get());
  else if (!ca.empty()) SSL_CTX_load_verify_locations(context.get(), ca.c_str(), nullptr);
  // Let the handshake succeed with any certificate; the fault is read afterwards.
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_NONE, nullptr);
  return context;
}

void ExpectName(SSL* session, const std::string& host) {
  X509_VERIFY_PARAM* const wanted = SSL_get0_param(session);
  if (X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1) return;
  ERR_clear_error();
  SSL_set1_host(session, host.c_str());
  SSL_set_tlsext_host_name(session, host.c_str());
}

std::int64_t EndOf(const X509* certificate) {
  std::tm end{};
  if (ASN1_TIME_to_tm(X509_get0_notAfter(certificate), &end) != 1) return 0;
  return ::timegm(&end);
}

void Look(SSL* session, CertificateSight& sight) {
  const X509* const certificate = SSL_get0_peer_certificate(session);
  if (certificate == nullptr) {
    sight.fault = "the server shows none";
    return;
  }
  sight.expires_s = EndOf(certificate);
  const long result = SSL_get_verify_result(session);
  if (result == X509_V_OK) return;
  sight.fault = X509_verify_cert_error_string(result);
  sight.is_expired = result == X509_V_ERR_CERT_HAS_EXPIRED;
  sight.is_of_other_name = result == X509_V_ERR_HOSTNAME_MISMATCH || result == X509_V_ERR_IP_ADDRESS_MISMATCH;
}

}  // namespace

CertificateSight LookAtCertificate(const std::string& address, const std::string& ca) {
  constexpr std::array<unsigned char, 3> kHttp2 = {2, 'h', '2'};
  CertificateSight sight;
  const auto place = PlaceOf(address);
  const int socket = place ? ConnectTo(*place) : -1;
  if (socket < 0) return sight;
  sight.is_reached = true;
  const TlsSettings context = SettingsFor(ca);
  const TlsSession session(context != nullptr ? SSL_new(context.get()) : nullptr, SSL_free);
  if (session != nullptr) {
    ExpectName(session.get(), place->host);
    SSL_set_alpn_protos(session.get(), kHttp2.data(), kHttp2.size());
    SSL_set_fd(session.get(), socket);
    sight.is_tls = SSL_connect(session.get()) == 1;
    if (sight.is_tls) Look(session.get(), sight);
  }
  ERR_clear_error();
  ::close(socket);
  return sight;
}

}  // namespace dhpmap
