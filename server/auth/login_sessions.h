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

/// Browsers that have logged in: each has a random word, good for 12 hours, which stands for its key. In memory alone:
/// they end with the server. Beyond kMost the oldest is forgotten, beyond kMostOfOne the oldest of that name.
/// Thread-safe.
class LoginSessions {
 public:
  static constexpr std::int64_t kLife_s = std::int64_t{12} * 3600;
  static constexpr std::size_t kMost = 10'000, kMostOfOne = 16;

  explicit LoginSessions(Randomness randomness) : randomness_(std::move(randomness)) {}

  /// Its word: 64 hexadecimal digits.
  std::string Begin(PrincipalPtr principal, std::int64_t now_s) DHPMAP_EXCLUDES(mutex_);
  /// Who has that word; null if nobody has, or no longer. Whether the key is still good is not asked here.
  PrincipalPtr Find(std::string_view word, std::int64_t now_s) DHPMAP_EXCLUDES(mutex_);
  void End(std::string_view word) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Login {
    PrincipalPtr principal;
    std::int64_t end_s = 0;
    std::uint64_t number = 0;  ///< of all that have begun
  };
  void Forget(std::map<Digest, Login>::iterator login) DHPMAP_REQUIRES(mutex_);
  /// Makes room for one more of that name.
  void MakeRoom(const std::string& name) DHPMAP_REQUIRES(mutex_);

  const Randomness randomness_;
  Mutex mutex_;
  std::uint64_t next_number_ DHPMAP_GUARDED_BY(mutex_) = 0;
  /// By the digest of its word, so that how long a search takes says nothing of the words.
  std::map<Digest, Login> logins_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Digest> by_age_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, std::set<std::uint64_t>> by_name_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
