// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mapping/base/result.h"

struct x509_st;
struct evp_pkey_st;

namespace dhpmap::net {

struct PemFree {
  void operator()(x509_st* certificate) const;
  void operator()(evp_pkey_st* key) const;
};
using Certificates = std::vector<std::unique_ptr<x509_st, PemFree>>;
using PrivateKey = std::unique_ptr<evp_pkey_st, PemFree>;

/// Returns at least one certificate. NOT_FOUND, INVALID_ARGUMENT.
Result<Certificates> ReadCertificates(const std::string& path);

/// The key must have no passphrase. FAILED_PRECONDITION if others than owner and group may read the file, or others
/// than the owner may write it; NOT_FOUND, INVALID_ARGUMENT.
Result<PrivateKey> ReadPrivateKey(const std::string& path);

}  // namespace dhpmap::net
