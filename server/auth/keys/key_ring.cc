// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_ring.h"

#include <utility>

namespace dhpmap::auth {
namespace {

Status Unauthenticated(std::string message) { return {StatusCode::kUnauthenticated, std::move(message)}; }
Status BadCredential() { return Unauthenticated("the key is none of this server's").WithReason("BAD_CREDENTIAL"); }
Status Revoked() { return Unauthenticated("the key has been revoked").WithReason("KEY_REVOKED"); }
Status Expired() { return Unauthenticated("the key has expired").WithReason("KEY_EXPIRED"); }

bool AreAlike(const Principal& a, const Principal& b) {
  return a.name == b.name && a.role == b.role && a.maps == b.maps && a.sessions == b.sessions;
}

}  // namespace

KeyRing::KeyRing(const std::vector<KeyRecord>& records) {
  for (const KeyRecord& record : records) {
    auto principal = std::make_shared<const Principal>(Principal{.name = record.name,
                                                                 .key_id = record.id,
                                                                 .role = record.role,
                                                                 .maps = record.maps,
                                                                 .sessions = record.sessions,
                                                                 .expires_s = record.expires_s});
    entries_.emplace(record.id, Entry{record.digest, record.revoked_s.has_value(), std::move(principal)});
  }
}

Result<PrincipalPtr> KeyRing::Find(std::string_view key_text, std::int64_t now_s) const {
  static const Entry nobody{};
  const auto key = ParseKeyText(key_text);
  const auto found = entries_.find(key ? key->id : std::string_view());
  const Entry& entry = found != entries_.end() ? found->second : nobody;
  const bool is_right = AreSame(DigestOf(key ? key->secret : std::string_view()), entry.digest);
  if (found == entries_.end() || !is_right) return BadCredential();
  if (entry.is_revoked) return Revoked();
  if (entry.principal->expires_s <= now_s) return Expired();
  return entry.principal;
}

Status KeyRing::Check(const Principal& principal, std::int64_t now_s) const {
  const auto found = entries_.find(principal.key_id);
  if (found == entries_.end() || found->second.is_revoked) return Revoked();
  if (found->second.principal->expires_s <= now_s) return Expired();
  if (!AreAlike(*found->second.principal, principal)) {
    return Unauthenticated("what the key may do has changed: call again").WithReason("KEY_REVOKED");
  }
  return Status::Ok();
}

}  // namespace dhpmap::auth
