// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "server/auth/keys/key_text.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

/// Login sessions of browsers. A random token stands for a key for 12 hours. Kept in memory only: they end with the
/// server. Beyond kMost the oldest is dropped, beyond kMostOfOne the oldest of the same principal. Thread-safe.
class LoginSessions {
 public:
  static constexpr std::int64_t kLife_s = std::int64_t{12} * 3600;
  static constexpr std::size_t kMost = 10'000, kMostOfOne = 16;

  explicit LoginSessions(Randomness randomness) : randomness_(std::move(randomness)) {}

  /// Returns the token: 64 hexadecimal digits.
  std::string Begin(PrincipalPtr principal, std::int64_t now_s) DHPMAP_EXCLUDES(mutex_);
  /// The principal of a token; null if it is unknown or expired. Does not check whether the key is still valid.
  PrincipalPtr Find(std::string_view word, std::int64_t now_s) DHPMAP_EXCLUDES(mutex_);
  void End(std::string_view word) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Login {
    PrincipalPtr principal;
    std::int64_t end_s = 0;
    std::uint64_t number = 0;  ///< ascending over all logins
  };
  void Forget(std::map<Digest, Login>::iterator login) DHPMAP_REQUIRES(mutex_);
  /// Drops a login if one more of that name exceeds a limit.
  void MakeRoom(const std::string& name) DHPMAP_REQUIRES(mutex_);

  const Randomness randomness_;
  Mutex mutex_;
  std::uint64_t next_number_ DHPMAP_GUARDED_BY(mutex_) = 0;
  /// By the token's digest, so that the time of a search reveals nothing about the tokens.
  std::map<Digest, Login> logins_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Digest> by_age_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, std::set<std::uint64_t>> by_name_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
