// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_text.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

/// What the server stores of a key: never the key itself.
struct KeyRecord {
  std::string id = {};
  std::string name = {};  ///< of its principal; several keys may have it during a rotation
  Role role = Role::kViewer;
  NamePatterns maps = {};
  NamePatterns sessions = {};
  Digest digest{};
  std::int64_t created_s = 0;
  std::int64_t expires_s = kNever_s;
  std::optional<std::int64_t> revoked_s = {};

  friend bool operator==(const KeyRecord&, const KeyRecord&) = default;
};

/// 1 to 64 of a-z A-Z 0-9 . _ -. No slash, because that separates a principal from the rest of an author's name.
bool IsPrincipalName(std::string_view name);

/// One line of JSON, without its newline.
std::string LineOf(const KeyRecord& record);
/// FAILED_PRECONDITION, reason BAD_KEY_FILE, for a malformed line; names the field, never its value.
Result<KeyRecord> RecordFromLine(std::string_view line);

}  // namespace dhpmap::auth
