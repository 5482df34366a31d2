// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/tls_files.h"

#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "server/net/descriptor.h"

namespace dhpmap::net {
namespace {

constexpr std::size_t kMost_bytes = 1u << 20;

using Bio = std::unique_ptr<BIO, int (*)(BIO*)>;

Result<std::string> ReadAll(const std::string& path, const Descriptor& file) {
  std::string text;
  std::array<char, 4096> part;
  while (text.size() < kMost_bytes) {
    const ssize_t got = ::read(file.get(), part.data(), part.size());
    if (got < 0) return NotFound("cannot read " + path + ": " + std::strerror(errno));
    if (got == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(got));
  }
  return InvalidArgument(path + " is too large to be a certificate or a key");
}

Result<Descriptor> Open(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) return NotFound("cannot read " + path + ": " + std::strerror(errno));
  return file;
}

Bio BioOf(const std::string& text) { return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), BIO_free}; }

/// Without it, OpenSSL would ask for a passphrase on the terminal.
int NoPassphrase(char* /*out*/, int /*size*/, int /*is_for_writing*/, void* /*unused*/) { return 0; }

}  // namespace

void PemFree::operator()(x509_st* certificate) const { X509_free(certificate); }
void PemFree::operator()(evp_pkey_st* key) const { EVP_PKEY_free(key); }

Result<Certificates> ReadCertificates(const std::string& path) {
  DHPMAP_ASSIGN_OR_RETURN(const Descriptor file, Open(path));
  DHPMAP_ASSIGN_OR_RETURN(const std::string text, ReadAll(path, file));
  const Bio in = BioOf(text);
  Certificates found;
  while (X509* one = PEM_read_bio_X509(in.get(), nullptr, NoPassphrase, nullptr)) found.emplace_back(one);
  const bool is_damaged = ERR_GET_REASON(ERR_peek_last_error()) != PEM_R_NO_START_LINE;  // else the end of the file
  ERR_clear_error();
  if (found.empty() || is_damaged) return InvalidArgument(path + " is no certificate in PEM");
  return found;
}

Result<PrivateKey> ReadPrivateKey(const std::string& path) {
  DHPMAP_ASSIGN_OR_RETURN(const Descriptor file, Open(path));
  struct stat found {};  // of the open file, not of the path, which may have changed
  if (::fstat(file.get(), &found) != 0) return NotFound("cannot read " + path + ": " + std::strerror(errno));
  if ((found.st_mode & (S_IROTH | S_IWOTH | S_IWGRP)) != 0) {
    return FailedPrecondition("other users may read or write the private key " + path + ": chmod 600 it");
  }
  DHPMAP_ASSIGN_OR_RETURN(const std::string text, ReadAll(path, file));
  const Bio in = BioOf(text);
  PrivateKey key(PEM_read_bio_PrivateKey(in.get(), nullptr, NoPassphrase, nullptr));
  ERR_clear_error();
  if (key == nullptr) return InvalidArgument(path + " is no private key in PEM without a passphrase");
  return key;
}

}  // namespace dhpmap::net
