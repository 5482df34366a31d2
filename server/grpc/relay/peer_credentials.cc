// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/peer_credentials.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "server/grpc/relay/owner_unreachable.h"

namespace dhpmap {
namespace {

/// No path: no text.
Result<std::string> PeerFileText(const std::string& path) {
  if (path.empty()) return std::string();
  std::ifstream file(path);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (text.empty()) return OwnerUnreachable("the TLS files for other servers cannot be used").WithCause(path);
  return text;
}

std::int64_t TimeOf(const std::string& path) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(path, error);
  return path.empty() || error ? 0 : time.time_since_epoch().count();
}

}  // namespace

Result<std::shared_ptr<grpc::ChannelCredentials>> PeerCredentials(const PeerTls& tls) {
  if (!tls.is_on) return grpc::InsecureChannelCredentials();
  DHPMAP_ASSIGN_OR_RETURN(const std::string ca, PeerFileText(tls.ca));
  DHPMAP_ASSIGN_OR_RETURN(const std::string key, PeerFileText(tls.key));
  DHPMAP_ASSIGN_OR_RETURN(const std::string cert, PeerFileText(tls.cert));
  return grpc::SslCredentials({.pem_root_certs = ca, .pem_private_key = key, .pem_cert_chain = cert});
}

PeerFileTimes PeerFileTimesOf(const PeerTls& tls) {
  if (!tls.is_on) return {};
  return {TimeOf(tls.ca), TimeOf(tls.cert), TimeOf(tls.key)};
}

}  // namespace dhpmap
