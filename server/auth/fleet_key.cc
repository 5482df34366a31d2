// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/fleet_key.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "server/auth/keys/key_file.h"
#include "server/auth/keys/key_record.h"

namespace dhpmap::auth {
namespace {

using Json = nlohmann::json;

Status BadPrincipal() { return InvalidArgument("a server passed on a caller that cannot be read"); }

}  // namespace

Result<std::shared_ptr<const FleetKey>> FleetKey::Read(const std::string& path) {
  auto file = ReadPrivateFile(path);
  if (!file.ok()) return file.status();
  std::istringstream lines(file->text);
  std::string line;
  std::getline(lines, line);
  return Make(std::move(line), path);
}

Result<std::shared_ptr<const FleetKey>> FleetKey::Make(std::string text, const std::string& where) {
  const auto is_plain = [](char c) { return c > ' ' && c < 0x7F; };
  if (text.size() < kLeastBytes || text.size() > kMostBytes || !std::all_of(text.begin(), text.end(), is_plain)) {
    return FailedPrecondition("the fleet key in " + where + " must be 32 to 1024 printable characters without spaces")
        .WithReason("BAD_KEY_FILE");
  }
  return std::shared_ptr<const FleetKey>(new FleetKey(std::move(text)));
}

std::string TextOf(const Principal& principal) {
  const Json json = {{"name", principal.name},
                     {"key", principal.key_id},
                     {"role", NameOf(principal.role)},
                     {"maps", principal.maps.texts()},
                     {"sessions", principal.sessions.texts()},
                     {"expires_s", principal.expires_s}};
  return json.dump(-1, ' ', /*ensure_ascii=*/true);
}

Result<PrincipalPtr> PrincipalFromText(std::string_view text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return BadPrincipal();
  Principal principal;
  std::vector<std::string> maps, sessions;
  try {
    principal.name = json.at("name").get<std::string>();
    principal.key_id = json.at("key").get<std::string>();
    principal.expires_s = json.at("expires_s").get<std::int64_t>();
    const auto role = RoleFromName(json.at("role").get<std::string>());
    if (!role || !IsPrincipalName(principal.name)) return BadPrincipal();
    principal.role = *role;
    maps = json.at("maps").get<std::vector<std::string>>();
    sessions = json.at("sessions").get<std::vector<std::string>>();
  } catch (const Json::exception&) {
    return BadPrincipal();
  }
  DHPMAP_ASSIGN_OR_RETURN(principal.maps, NamePatterns::Make(std::move(maps)));
  if (!sessions.empty()) {  // of a role that feeds nothing there are none
    DHPMAP_ASSIGN_OR_RETURN(principal.sessions, NamePatterns::Make(std::move(sessions)));
  }
  return std::make_shared<const Principal>(std::move(principal));
}

}  // namespace dhpmap::auth
