// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "mapping/base/result.h"
#include "server/auth/keys/key_text.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

// Metadata of a call that one server of a fleet passes on to another.
inline constexpr char kFleetKeyKey[] = "dhpmap-fleet-key";   ///< the secret that proves a server
inline constexpr char kPrincipalKey[] = "dhpmap-principal";  ///< for whom it asks, see TextOf; of a fleet with keys

/// The secret that all servers of a fleet share. Immutable, so thread-safe.
class FleetKey {
 public:
  static constexpr std::size_t kLeastBytes = 32, kMostBytes = 1024;

  /// The first line of a file. FAILED_PRECONDITION, reason BAD_KEY_FILE, as of
  /// ReadPrivateFile, and for a secret that is too short, too long or not printable ASCII without spaces.
  static Result<std::shared_ptr<const FleetKey>> Read(const std::string& path);
  /// The same of a text; `where` names it in errors.
  static Result<std::shared_ptr<const FleetKey>> Make(std::string text, const std::string& where);

  [[nodiscard]] const std::string& text() const { return text_; }
  /// In a time that does not depend on where they differ.
  [[nodiscard]] bool Is(std::string_view text) const { return AreSame(digest_, DigestOf(text)); }

 private:
  explicit FleetKey(std::string text) : text_(std::move(text)), digest_(DigestOf(text_)) {}

  const std::string text_;
  const Digest digest_;
};

/// A principal as one line of printable ASCII, for kPrincipalKey.
std::string TextOf(const Principal& principal);
/// INVALID_ARGUMENT for what is no such line.
Result<PrincipalPtr> PrincipalFromText(std::string_view text);

}  // namespace dhpmap::auth
