// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_book.h"

#include <algorithm>
#include <utility>

#include "server/auth/keys/key_file.h"

namespace dhpmap::auth {
namespace {

Status NoKey(std::string_view name) {
  return NotFound("there is no key of the name or id '" + std::string(name.substr(0, 64)) + "'")
      .WithReason("KEY_NOT_FOUND");
}

bool IsGood(const KeyRecord& record, std::int64_t now_s) { return !record.revoked_s && record.expires_s > now_s; }

/// Adds a record with a new random id. A collision is reported; by chance it takes some 2^24 keys.
Result<ShownKey> Add(KeyRecord record, const Randomness& randomness, std::vector<KeyRecord>& records) {
  if (records.size() >= kMostKeys) {
    return InvalidArgument("there are as many keys as there may be: take out old ones").WithReason("BAD_KEY");
  }
  std::string text = MakeKeyText(randomness);
  const auto parsed = ParseKeyText(text);
  record.id = parsed->id;
  record.digest = DigestOf(parsed->secret);
  const auto is_same = [&](const KeyRecord& other) { return other.id == record.id; };
  if (std::any_of(records.begin(), records.end(), is_same)) return Internal("two keys have the same id");
  records.push_back(record);
  return ShownKey{.text = std::move(text), .record = std::move(record)};
}

}  // namespace

Result<ShownKey> AddKey(const NewKey& wanted, std::int64_t now_s, const Randomness& randomness,
                        std::vector<KeyRecord>& records) {
  if (!IsPrincipalName(wanted.name)) {
    return InvalidArgument("a key's name has 1 to 64 letters, digits and . _ -").WithReason("BAD_KEY");
  }
  if (wanted.expires_s <= now_s) return InvalidArgument("the key would have expired already").WithReason("BAD_KEY");
  const bool is_admin = wanted.role == Role::kAdmin;
  const std::vector<std::string> own =
      is_admin ? std::vector<std::string>{"*"} : std::vector<std::string>{wanted.name, wanted.name + "-*"};
  KeyRecord record{.name = wanted.name, .role = wanted.role, .created_s = now_s, .expires_s = wanted.expires_s};
  DHPMAP_ASSIGN_OR_RETURN(record.maps, NamePatterns::Make(wanted.maps));
  DHPMAP_ASSIGN_OR_RETURN(record.sessions, NamePatterns::Make(wanted.sessions.empty() ? own : wanted.sessions));
  return Add(std::move(record), randomness, records);
}

Result<ShownKey> RotateKey(std::string_view name, std::int64_t overlap_s, std::int64_t now_s,
                           const Randomness& randomness, std::vector<KeyRecord>& records) {
  const auto is_meant = [&](const KeyRecord& record) { return record.name == name && IsGood(record, now_s); };
  const auto newest = std::find_if(records.rbegin(), records.rend(), is_meant);
  if (newest == records.rend()) return NoKey(name);
  const auto differs = [&](const KeyRecord& record) {
    return is_meant(record) &&
           (record.role != newest->role || record.maps != newest->maps || record.sessions != newest->sessions);
  };
  if (std::any_of(records.begin(), records.end(), differs)) {
    return InvalidArgument("the keys of '" + std::string(name) +
                           "' may do different things: revoke those that are not meant by their ids")
        .WithReason("BAD_KEY");
  }
  KeyRecord next = *newest;
  if (next.expires_s != kNever_s) next.expires_s = now_s + (next.expires_s - next.created_s);
  next.created_s = now_s;
  for (KeyRecord& record : records) {
    if (is_meant(record)) record.expires_s = std::min(record.expires_s, now_s + overlap_s);
  }
  return Add(std::move(next), randomness, records);
}

Result<int> RevokeKeys(std::string_view id_or_name, std::int64_t now_s, std::vector<KeyRecord>& records) {
  int num_met = 0, num_revoked = 0;
  for (KeyRecord& record : records) {
    if (record.id != id_or_name && record.name != id_or_name) continue;
    ++num_met;
    if (record.revoked_s) continue;
    record.revoked_s = now_s;
    ++num_revoked;
  }
  if (num_met == 0) return NoKey(id_or_name);
  return num_revoked;
}

}  // namespace dhpmap::auth
