// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/server/net/test_certificates.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace dhpmap::testing {
namespace {

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

void Require(bool holds) {
  if (!holds) std::abort();
}

File OpenFile(const std::string& path, const char* mode) {
  File file(std::fopen(path.c_str(), mode), std::fclose);
  Require(file != nullptr);
  return file;
}

void AddExtension(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
  Require(extension != nullptr && X509_add_ext(certificate, extension, -1) == 1);
  X509_EXTENSION_free(extension);
}

Certificate Describe(const CertificateWish& wish, EVP_PKEY* key) {
  constexpr long kDay_s = 86'400;
  static std::atomic<long> serial = 1;
  Certificate certificate(X509_new(), X509_free);
  X509_set_version(certificate.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), serial++);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -2 * kDay_s);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), wish.is_expired ? -kDay_s : kDay_s);
  X509_set_pubkey(certificate.get(), key);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()), "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(wish.common_name.c_str()), -1, -1, 0);
  return certificate;
}

void Sign(X509* certificate, EVP_PKEY* key, const CertificateWish& wish) {
  if (wish.signed_by == nullptr) {
    X509_set_issuer_name(certificate, X509_get_subject_name(certificate));
    AddExtension(certificate, certificate, NID_basic_constraints, "critical,CA:TRUE");
    AddExtension(certificate, certificate, NID_subject_alt_name, wish.alt_names);
    Require(X509_sign(certificate, key, EVP_sha256()) > 0);
    return;
  }
  const Certificate issuer(PEM_read_X509(OpenFile(wish.signed_by->cert, "r").get(), nullptr, nullptr, nullptr),
                           X509_free);
  const Key issuer_key(PEM_read_PrivateKey(OpenFile(wish.signed_by->key, "r").get(), nullptr, nullptr, nullptr),
                       EVP_PKEY_free);
  X509_set_issuer_name(certificate, X509_get_subject_name(issuer.get()));
  AddExtension(certificate, issuer.get(), NID_subject_alt_name, wish.alt_names);
  Require(X509_sign(certificate, issuer_key.get(), EVP_sha256()) > 0);
}

}  // namespace

CertificateFiles MakeCertificate(const std::filesystem::path& folder, const std::string& name,
                                 const CertificateWish& wish) {
  const CertificateFiles files{.cert = (folder / (name + ".crt")).string(), .key = (folder / (name + ".key")).string()};
  const Key key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const Certificate certificate = Describe(wish, key.get());
  Sign(certificate.get(), key.get(), wish);
  Require(PEM_write_X509(OpenFile(files.cert, "w").get(), certificate.get()) == 1);
  Require(PEM_write_PrivateKey(OpenFile(files.key, "w").get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1);
  ::chmod(files.key.c_str(), 0600);
  return files;
}

}  // namespace dhpmap::testing
