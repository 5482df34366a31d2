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
  std::vector<std::string> sessions;  ///< empty: its own name, alone or followed by "-..."
  std::int64_t expires_s = kNever_s;
};

/// The key for its owner, shown once: the text is stored nowhere.
struct ShownKey {
  std::string text;
  KeyRecord record;
};

/// Edits the records of a key file in place. Pure: no files and no clock; random numbers come from the caller.

/// Adds a key. INVALID_ARGUMENT, reason BAD_KEY, for bad values or beyond kMostKeys.
Result<ShownKey> AddKey(const NewKey& wanted, std::int64_t now_s, const Randomness& randomness,
                        std::vector<KeyRecord>& records);
/// Adds a key like the newest valid one of `name`, with the same lifetime. All valid keys of that name then expire at
/// `now_s + overlap_s`, unless they expire earlier. NOT_FOUND, reason KEY_NOT_FOUND; INVALID_ARGUMENT, reason BAD_KEY,
/// if these keys differ in role, maps or sessions.
Result<ShownKey> RotateKey(std::string_view name, std::int64_t overlap_s, std::int64_t now_s,
                           const Randomness& randomness, std::vector<KeyRecord>& records);
/// Revokes the key with this id, or all of this name; returns how many. NOT_FOUND, reason KEY_NOT_FOUND.
Result<int> RevokeKeys(std::string_view id_or_name, std::int64_t now_s, std::vector<KeyRecord>& records);

}  // namespace dhpmap::auth
