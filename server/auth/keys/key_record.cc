// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/auth/keys/utc_text.h"

namespace dhpmap::auth {
namespace {

using Json = nlohmann::json;

Status BadField(const char* field) {
  return FailedPrecondition(std::string("its field '") + field + "' is missing or not usable")
      .WithReason("BAD_KEY_FILE");
}

std::optional<std::string> TextOf(const Json& json, const char* field) {
  const auto found = json.find(field);
  if (found == json.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

/// `absent` if the field is missing; nothing if it is not a time.
std::optional<std::int64_t> TimeOf(const Json& json, const char* field, std::int64_t absent) {
  if (!json.contains(field)) return absent;
  const auto text = TextOf(json, field);
  return text ? UtcFromText(*text) : std::nullopt;
}

std::optional<NamePatterns> PatternsOf(const Json& json, const char* field) {
  const auto found = json.find(field);
  if (found == json.end() || !found->is_array()) return std::nullopt;
  std::vector<std::string> texts;
  for (const Json& text : *found) {
    if (!text.is_string()) return std::nullopt;
    texts.push_back(text.get<std::string>());
  }
  auto patterns = NamePatterns::Make(std::move(texts));
  if (!patterns.ok()) return std::nullopt;
  return *std::move(patterns);
}

bool IsKeyId(const std::string& id) {
  return id.size() == kKeyIdDigits &&
         std::all_of(id.begin(), id.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace

bool IsPrincipalName(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  });
}

std::string LineOf(const KeyRecord& record) {
  nlohmann::ordered_json json;
  json["id"] = record.id;
  json["name"] = record.name;
  json["role"] = NameOf(record.role);
  json["maps"] = record.maps.texts();
  json["sessions"] = record.sessions.texts();
  json["sha256"] = HexOf(record.digest);
  json["created"] = UtcText(record.created_s);
  if (record.expires_s != kNever_s) json["expires"] = UtcText(record.expires_s);
  if (record.revoked_s) json["revoked"] = UtcText(*record.revoked_s);
  return json.dump();
}

Result<KeyRecord> RecordFromLine(std::string_view line) {
  const Json json = Json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return FailedPrecondition("it is no JSON object").WithReason("BAD_KEY_FILE");
  KeyRecord record;
  record.id = TextOf(json, "id").value_or("");
  if (!IsKeyId(record.id)) return BadField("id");
  record.name = TextOf(json, "name").value_or("");
  if (!IsPrincipalName(record.name)) return BadField("name");
  const auto role = RoleFromName(TextOf(json, "role").value_or(""));
  if (!role) return BadField("role");
  const auto maps = PatternsOf(json, "maps"), sessions = PatternsOf(json, "sessions");
  if (!maps) return BadField("maps");
  if (!sessions) return BadField("sessions");
  const auto digest = DigestFromHex(TextOf(json, "sha256").value_or(""));
  if (!digest) return BadField("sha256");
  const auto created_s = TimeOf(json, "created", 0), expires_s = TimeOf(json, "expires", kNever_s);
  if (!created_s) return BadField("created");
  if (!expires_s) return BadField("expires");
  if (json.contains("revoked")) {
    record.revoked_s = TimeOf(json, "revoked", 0);
    if (!record.revoked_s) return BadField("revoked");
  }
  record.role = *role;
  record.maps = *maps;
  record.sessions = *sessions;
  record.digest = *digest;
  record.created_s = *created_s;
  record.expires_s = *expires_s;
  return record;
}

}  // namespace dhpmap::auth
