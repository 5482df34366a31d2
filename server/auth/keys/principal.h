// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/auth/keys/name_patterns.h"
#include "server/auth/keys/role.h"

namespace dhpmap::auth {

/// Expiry time of a key that never expires.
inline constexpr std::int64_t kNever_s = INT64_MAX;

/// An authenticated caller. Immutable once it is shared.
struct Principal {
  std::string name = {};    ///< edits are logged under it
  std::string key_id = {};  ///< empty: the server runs without keys
  Role role = Role::kViewer;
  NamePatterns maps = {};
  NamePatterns sessions = {};
  std::int64_t expires_s = kNever_s;  ///< s since 1970, UTC
};
using PrincipalPtr = std::shared_ptr<const Principal>;

}  // namespace dhpmap::auth
