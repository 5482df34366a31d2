// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/credentials.h"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <string_view>
#include <system_error>

#include "clients/cpp/calls/error.h"

namespace dhpmap::client {
namespace {

constexpr int kMostToken = 4096;

bool IsThisMachine(std::string_view address) {
  if (address.starts_with("unix:") || address.starts_with("[::1]:")) return true;
  const std::string_view host = address.substr(0, address.rfind(':'));
  return host == "localhost" ||
         (host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string_view::npos);
}

/// Reads the named PEM file into `text`; an empty name leaves `text` unchanged.
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
    if (!(options.token.empty() && options.token_file.empty()) && !IsThisMachine(address)) {
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

Result<std::string> TokenOf(const ConnectOptions& options) {
  if (options.token_file.empty()) return options.token;
  const std::string& file = options.token_file;
  if (!options.token.empty()) return BadArgument("token_file", "and token: give one of them");
  std::error_code failed;
  using std::filesystem::perms;
  const perms of_others = std::filesystem::status(file, failed).permissions() & (perms::group_all | perms::others_all);
  std::ifstream in(file);
  if (failed || !in.is_open()) return BadArgument("token_file", "cannot read " + file);
  if (of_others != perms::none) {
    return BadArgument("token_file", file + " is open to others than its owner: chmod 600 it");
  }
  std::string token;
  char more = 0;
  if (!(in >> std::setw(kMostToken) >> token) || in >> more) return BadArgument("token_file", file + " holds no key");
  return token;
}

}  // namespace dhpmap::client
