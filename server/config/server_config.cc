// SPDX-License-Identifier: BSD-3-Clause
#include "server/config/server_config.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <regex>
#include <sstream>
#include <type_traits>
#include <utility>

namespace dhpmap {
namespace {

constexpr std::array<std::string_view, 5> kLogLevels = {"debug", "info", "warning", "error", "off"};

bool HasPort(std::string_view address) {
  if (address.starts_with("unix:")) return address.size() > 5;
  const std::size_t colon = address.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  const std::string_view digits = address.substr(colon + 1);
  int port = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  return error == std::errc() && end == digits.data() + digits.size() && port >= 0 && port <= 65535;
}

void CheckAddress(const char* key, const std::string& address, Status& bad) {
  if (!HasPort(address)) bad.AddViolation(key, "'" + address + "' is not host:port");
}

void CheckReach(const char* key, const std::string& address, const std::string& lacks, Status& bad) {
  if (!HasPort(address) || IsLoopback(address) || lacks.empty()) return;
  bad.AddViolation(key, "'" + address + "' can be reached from other machines, and there is " + lacks);
}

void CheckTls(const ServerConfig::Tls& tls, Status& bad) {
  if (tls.cert.empty() != tls.key.empty()) {
    bad.AddViolation(tls.cert.empty() ? "tls.cert" : "tls.key", "is missing: a certificate and its key go together");
  }
  const bool has_clients = tls.client_auth == "optional" || tls.client_auth == "required";
  if (!has_clients && tls.client_auth != "none") {
    bad.AddViolation("tls.client_auth", "'" + tls.client_auth + "' is not none, optional or required");
  } else if (has_clients && (tls.client_ca.empty() || !tls.is_on())) {
    bad.AddViolation("tls.client_auth", "'" + tls.client_auth + "' needs tls.client_ca, tls.cert and tls.key");
  } else if (!has_clients && !tls.client_ca.empty()) {
    bad.AddViolation("tls.client_ca", "is for nothing while tls.client_auth is none");
  }
}

void CheckFleet(const ServerConfig& config, Status& bad) {
  const bool is_file = !DatabaseFileOf(config).empty();
  if (is_file && !config.fleet.address.empty()) {
    bad.AddViolation("fleet.address", "needs a postgresql:// database: a file has one server");
  }
  if (is_file && !config.fleet.key_file.empty()) {
    bad.AddViolation("fleet.key_file", "is for servers on a postgresql:// database");
  }
  if (!config.fleet.ca.empty() && (is_file || !config.tls.is_on())) {
    bad.AddViolation("fleet.ca", "is for servers on a postgresql:// database, with TLS");
  }
}

/// As browsers send them, or none would ever match: "*" is none, and so is a port that goes without saying.
void CheckOrigins(const std::string& origins, Status& bad) {
  static const std::regex pattern(R"((http|https)://([a-z0-9._-]+|\[[0-9a-f:]+\])(:[1-9][0-9]{0,4})?)");
  for (const std::string& origin : SplitByComma(origins)) {
    const bool has_default_port = (origin.starts_with("http:") && origin.ends_with(":80")) ||
                                  (origin.starts_with("https:") && origin.ends_with(":443"));
    if (std::regex_match(origin, pattern) && !has_default_port) continue;
    bad.AddViolation("http.allowed_origins",
                     "'" + origin + "' is not an origin as browsers send it, such as https://fleet.example:8443");
  }
}

template <typename Number>
void CheckRange(const char* key, Number value, double least, double most, Status& bad) {
  const auto number = static_cast<double>(value);
  if (number >= least && number <= most) return;
  std::ostringstream text;
  text << number << " is not within " << least << " and " << most;
  bad.AddViolation(key, text.str());
}

}  // namespace

Status ServerConfig::Validate() const {
  Status bad = InvalidArgument("the configuration is not usable").WithReason("BAD_CONFIG");
  VisitServerFields(*this, [&bad](const char* key, const auto& value, double least, double most, const char*) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (!std::is_same_v<Value, bool> && std::is_arithmetic_v<Value>) CheckRange(key, value, least, most, bad);
  });
  CheckAddress("grpc.address", grpc.address, bad);
  CheckAddress("http.address", http.address, bad);
  // A database server may have keys: that is checked once it is asked.
  const bool may_have_keys = !KeyFileOf(*this).empty() || DatabaseFileOf(*this).empty();
  const Status exposure = CheckExposure(*this, tls.is_on(), may_have_keys);
  for (const FieldViolation& violation : exposure.violations()) {
    bad.AddViolation(violation.field, violation.description);
  }
  CheckOrigins(http.allowed_origins, bad);
  if (auth.audit_required && auth.audit.empty()) bad.AddViolation("auth.audit_required", "needs auth.audit");
  CheckTls(tls, bad);
  CheckFleet(*this, bad);
  if (std::find(kLogLevels.begin(), kLogLevels.end(), log.level) == kLogLevels.end()) {
    bad.AddViolation("log.level", "'" + log.level + "' is not debug, info, warning, error or off");
  }
  const Status map = map_defaults.Validate();
  for (const FieldViolation& violation : map.violations()) {
    bad.AddViolation("map_defaults." + violation.field, violation.description);
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

std::vector<std::string> SplitByComma(const std::string& text) {
  std::vector<std::string> parts;
  std::string part;
  for (const char c : text + ",") {
    if (c == ',') {
      if (!part.empty()) parts.push_back(std::exchange(part, {}));
    } else if (c != ' ') {
      part += c;
    }
  }
  return parts;
}

std::string DatabaseFileOf(const ServerConfig& config) {
  return config.db.find("://") == std::string::npos ? config.db : "";
}

std::string KeyFileOf(const ServerConfig& config) {
  if (!config.auth.keys.empty() || DatabaseFileOf(config).empty()) return config.auth.keys;
  std::error_code error;
  // Look next to the database and next to the link to it. Any file counts, even a dangling link: keys are off only if
  // nothing is there.
  for (const std::string& db : {config.db, std::filesystem::weakly_canonical(config.db, error).string()}) {
    const std::string beside = db + ".keys";
    if (std::filesystem::symlink_status(beside, error).type() != std::filesystem::file_type::not_found) return beside;
  }
  return "";
}

std::vector<std::string> ChangedKeys(const ServerConfig& before, const ServerConfig& after) {
  std::vector<std::string> keys;
  VisitServerFields(before, [&](const char* key, const auto& was, double, double, const char*) {
    bool is_same = true;
    VisitServerFields(after, [&](const char* other, const auto& is, double, double, const char*) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(was)>, std::remove_cvref_t<decltype(is)>>) {
        if (std::string_view(key) == other) is_same = was == is;
      }
    });
    if (!is_same) keys.emplace_back(key);
  });
  if (ConfigToText(before.map_defaults) != ConfigToText(after.map_defaults)) keys.emplace_back("map_defaults");
  return keys;
}

bool IsInsecure(const ServerConfig& config) {
  return config.insecure || config.insecure_no_tls || config.insecure_no_auth;
}

Status CheckExposure(const ServerConfig& config, bool has_tls, bool has_keys) {
  const bool lacks_tls = !has_tls && !config.insecure && !config.insecure_no_tls;
  const bool lacks_keys = !has_keys && !config.insecure && !config.insecure_no_auth;
  std::string lacks;
  if (lacks_tls) lacks += "no TLS (--insecure-no-tls allows it)";
  if (lacks_keys) {
    lacks +=
        std::string(lacks.empty() ? "" : ", and there are ") +
        "no keys (`dhpmap keys create` makes one, in a file, which auth.keys names, or in a postgresql:// database; "
        "--insecure-no-auth goes without)";
  }
  Status bad = InvalidArgument("the server would be open to strangers").WithReason("BAD_CONFIG");
  CheckReach("grpc.address", config.grpc.address, lacks, bad);
  CheckReach("http.address", config.http.address, lacks, bad);
  return bad.violations().empty() ? Status::Ok() : bad;
}

std::string EnvironmentName(std::string_view key) {
  std::string name = "DHPMAP_";
  for (const char c : key) {
    name += c == '.' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return name;
}

bool IsLoopback(std::string_view address) {
  if (address.starts_with("unix:")) return true;
  const std::string_view host = address.substr(0, address.rfind(':'));
  const auto is_part_of_v4 = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return host == "localhost" || host == "[::1]" ||
         (host.starts_with("127.") && std::all_of(host.begin(), host.end(), is_part_of_v4));
}

}  // namespace dhpmap
