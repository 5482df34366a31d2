// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_record.h"

namespace dhpmap::auth {

struct NewKey {
  std::string name;
  Role role = Role::kViewer;
  std::vector<std::string> maps = {"*"};
  std::vector<std::string> sessions;  ///< none: those of its own name, alone or with "-..." behind it
  std::int64_t expires_s = kNever_s;
};

/// What its owner gets, once: it is stored nowhere.
struct ShownKey {
  std::string text;
  KeyRecord record;
};

/// Of a file's records, in place: no files, no clock, no secrets of its own.

/// Adds a key. INVALID_ARGUMENT, reason BAD_KEY, also beyond kMostKeys.
Result<ShownKey> AddKey(const NewKey& wanted, std::int64_t now_s, const Randomness& randomness,
                        std::vector<KeyRecord>& records);
/// Adds one like the newest that `name` has and that is good now; all that it had end at `now_s + overlap_s`, unless
/// they end before. The new one is good for as long as that was made for. NOT_FOUND, reason KEY_NOT_FOUND.
Result<ShownKey> RotateKey(std::string_view name, std::int64_t overlap_s, std::int64_t now_s,
                           const Randomness& randomness, std::vector<KeyRecord>& records);
/// Revokes the key of this id, or all of this name; how many. NOT_FOUND, reason KEY_NOT_FOUND.
Result<int> RevokeKeys(std::string_view id_or_name, std::int64_t now_s, std::vector<KeyRecord>& records);

}  // namespace dhpmap::auth
