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

/// The keys of a file as it was, found by id. Immutable, so thread-safe.
class KeyRing {
 public:
  explicit KeyRing(const std::vector<KeyRecord>& records);

  /// Whose key this is. UNAUTHENTICATED with reason BAD_CREDENTIAL, in the same words and the same time whether there
  /// is no such id or the secret is wrong; only who has the secret learns that it is revoked (KEY_REVOKED) or past its
  /// time (KEY_EXPIRED).
  [[nodiscard]] Result<PrincipalPtr> Find(std::string_view key_text, std::int64_t now_s) const;

  /// Why a principal that was found before is none now, or is another: OK if it still is as it was.
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
