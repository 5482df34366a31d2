// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_record.h"

namespace dhpmap::auth {

/// The keys of a file at one moment, found by id. Immutable, so thread-safe.
class KeyRing {
 public:
  explicit KeyRing(const std::vector<KeyRecord>& records);

  /// The principal of a key. UNAUTHENTICATED, reason BAD_CREDENTIAL, for an unknown id or a wrong secret: message and
  /// time are the same for both. Only a caller with the right secret learns that the key is revoked (KEY_REVOKED) or
  /// expired (KEY_EXPIRED).
  [[nodiscard]] Result<PrincipalPtr> Find(std::string_view key_text, std::int64_t now_s) const;

  /// OK if a principal that was found before is still valid and unchanged; else the reason.
  [[nodiscard]] Status Check(const Principal& principal, std::int64_t now_s) const;

 private:
  struct Entry {
    Digest digest;
    bool is_revoked;
    PrincipalPtr principal;
  };
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace dhpmap::auth
