// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/credentials.h"

#include <fstream>
#include <iterator>

#include "clients/cpp/src/error.h"

namespace dhpmap::client {
namespace {

bool IsThisMachine(const std::string& address) {
  return address.starts_with("localhost:") || address.starts_with("127.0.0.1:") || address.starts_with("[::1]:") ||
         address.starts_with("unix:");
}

/// Reads a PEM file into `text`, unless none is named.
Status ReadPem(const char* option, const std::string& file, std::string& text) {
  if (file.empty()) return {};
  std::ifstream in(file, std::ios::binary);
  text.assign(std::istreambuf_iterator<char>(in), {});
  if (!in.is_open() || text.empty()) return BadArgument(option, "cannot read " + file);
  return {};
}

}  // namespace

Result<std::shared_ptr<grpc::ChannelCredentials>> CredentialsFor(const std::string& address,
                                                                 const ConnectOptions& options) {
  const bool over_tls = options.tls || !options.ca_file.empty() || !options.cert_file.empty();
  if (!over_tls) {
    if (!options.token.empty() && !IsThisMachine(address)) {
      return BadArgument("token", "would go to " + address + " in the clear: connect with tls or ca_file");
    }
    return grpc::InsecureChannelCredentials();
  }
  if (options.cert_file.empty() != options.key_file.empty()) {
    return BadArgument("cert_file", "and key_file come together");
  }
  grpc::SslCredentialsOptions ssl;
  for (const Status& read : {ReadPem("ca_file", options.ca_file, ssl.pem_root_certs),
                             ReadPem("cert_file", options.cert_file, ssl.pem_cert_chain),
                             ReadPem("key_file", options.key_file, ssl.pem_private_key)}) {
    if (!read.ok()) return read;
  }
  return grpc::SslCredentials(ssl);
}

}  // namespace dhpmap::client
