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

/// At least one. NOT_FOUND, INVALID_ARGUMENT.
Result<Certificates> ReadCertificates(const std::string& path);

/// Without a passphrase. FAILED_PRECONDITION if users other than its owner and group may read it, or others than its
/// owner write it; NOT_FOUND, INVALID_ARGUMENT.
Result<PrivateKey> ReadPrivateKey(const std::string& path);

}  // namespace dhpmap::net
