// SPDX-License-Identifier: BSD-3-Clause
#include "server/config/config_loader.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

constexpr std::string_view kMapDefaults = "map_defaults.";

Status BadYaml(const std::string& what) {
  return InvalidArgument("the configuration file cannot be read: " + what).WithReason("BAD_CONFIG");
}

int LineOf(const YAML::Node& node) { return node.Mark().line + 1; }

Status BadYamlAt(const YAML::Node& node, const std::string& what) {
  return BadYaml("line " + std::to_string(LineOf(node)) + ": " + what);
}

/// Nested mappings as dotted keys. Aliases may make a short document huge or infinite.
class Flattener {
 public:
  Status Add(const YAML::Node& mapping, const std::string& prefix) {
    open_.push_back(mapping);
    for (const auto& item : mapping) DHPMAP_RETURN_IF_ERROR(AddItem(item.first, item.second, prefix));
    open_.pop_back();
    return Status::Ok();
  }
  KeyValues Take() { return std::move(values_); }

 private:
  static constexpr std::size_t kMostKeys = 10'000;

  Status AddItem(const YAML::Node& name, const YAML::Node& value, const std::string& prefix) {
    const std::string key = prefix + name.as<std::string>();
    const auto [first, is_new] = lines_.emplace(key, LineOf(name));
    if (!is_new) return BadYamlAt(name, "'" + key + "' is in line " + std::to_string(first->second) + " already");
    if (lines_.size() > kMostKeys) return BadYamlAt(name, "there are more than 10000 keys");
    if (std::any_of(open_.begin(), open_.end(), [&](const YAML::Node& around) { return around.is(value); })) {
      return BadYamlAt(name, "'" + key + "' is an alias of what it is in");
    }
    if (value.IsMap()) return Add(value, key + ".");
    if (value.IsSequence()) return BadYamlAt(name, "'" + key + "' is a list");
    if (value.IsScalar()) values_.emplace_back(key, value.Scalar());  // else a section whose keys are all commented out
    return Status::Ok();
  }

  KeyValues values_;
  std::map<std::string, int> lines_;
  std::vector<YAML::Node> open_;  ///< the mappings that contain the current one
};

bool Parse(const std::string& text, std::string& value) {
  value = text;
  return true;
}
bool Parse(const std::string& text, bool& value) {
  value = text == "true";
  return text == "true" || text == "false";
}
template <typename Number>
bool Parse(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// New names of keys of version 0.1.
std::string_view RenamedTo(std::string_view key) {
  if (key == "http.head_timeout_s") return "http.header_timeout_s";
  if (key == "store.busy_timeout_ms") return "store.busy_timeout_s, in seconds";
  return {};
}

void SetOne(const std::string& wanted, const std::string& text, ServerConfig& config, Status& bad) {
  if (wanted.starts_with(kMapDefaults)) {
    const Status status = SetField(config.map_defaults, std::string_view(wanted).substr(kMapDefaults.size()), text);
    for (const FieldViolation& violation : status.violations()) bad.AddViolation(wanted, violation.description);
    return;
  }
  bool is_known = false;
  VisitServerFields(config, [&](const char* key, auto& value, double, double, const char*) {
    if (wanted != key) return;
    is_known = true;
    auto candidate = value;
    if (Parse(text, candidate)) value = std::move(candidate);
    else bad.AddViolation(wanted, "cannot be '" + text + "'");
  });
  if (is_known) return;
  const std::string_view renamed = RenamedTo(wanted);
  bad.AddViolation(wanted, renamed.empty() ? "unknown key" : "is now called " + std::string(renamed));
}

std::string Format(const std::string& value) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}
std::string Format(bool value) { return value ? "true" : "false"; }
std::string Format(int value) { return std::to_string(value); }
std::string Format(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}
std::string Format(Weighting value) { return std::string(WeightingName(value)); }

/// Writes "a.b.c" as nested mappings; opens the sections that differ from the previous key.
class NestedWriter {
 public:
  void Write(std::string key, const std::string& value, const char* help) {
    std::vector<std::string> sections;
    for (std::size_t dot = 0; (dot = key.find('.')) != std::string::npos; key.erase(0, dot + 1)) {
      sections.push_back(key.substr(0, dot));
    }
    for (std::size_t i = 0; i < sections.size(); ++i) {
      if (i < open_.size() && open_[i] == sections[i]) continue;
      open_.resize(i);
      open_.push_back(sections[i]);
      text_ << Indent(i) << sections[i] << ":\n";
    }
    open_.resize(sections.size());
    text_ << Indent(sections.size()) << key << ": " << value << "  # " << help << "\n";
  }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  static std::string Indent(std::size_t depth) { return std::string(2 * depth, ' '); }

  std::ostringstream text_;
  std::vector<std::string> open_;
};

}  // namespace

Result<KeyValues> ParseYaml(const std::string& text) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) return BadYamlAt(documents[1], "a second document begins");
    if (documents.empty() || documents[0].IsNull()) return KeyValues();
    if (!documents[0].IsMap()) return BadYaml("it is not a mapping of keys to values");
    Flattener flattener;
    DHPMAP_RETURN_IF_ERROR(flattener.Add(documents[0], ""));
    return flattener.Take();
  } catch (const YAML::Exception& error) {
    return BadYaml(error.what());
  }
}

Result<std::string> ReadConfigFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) return NotFound("cannot read the configuration file " + path);
  return text;
}

KeyValues KeysFromEnvironment(const std::vector<std::string>& environment) {
  std::vector<std::string> known;
  ServerConfig config;
  VisitServerFields(config, [&known](const char* key, const auto&, double, double, const char*) {
    // Switches that expose the server must be visible: in the file or as a flag, not in the environment.
    if (!std::string_view(key).starts_with("insecure")) known.emplace_back(key);
  });
  for (const auto& [key, value] : ConfigToText(config.map_defaults)) known.push_back(std::string(kMapDefaults) + key);
  for (const RetiredField& field : RetiredFields()) known.push_back(std::string(kMapDefaults).append(field.key));

  KeyValues values;
  for (const std::string& variable : environment) {
    const bool is_of_clients = variable.starts_with("DHPMAP_SERVER=") || variable.starts_with("DHPMAP_AUTHOR=");
    if (!variable.starts_with("DHPMAP_") || is_of_clients) continue;
    const std::size_t equals = variable.find('=');
    const std::string name = variable.substr(0, equals);
    std::string key = name;
    for (const std::string& candidate : known) {
      if (EnvironmentName(candidate) == name) key = candidate;
    }
    values.emplace_back(key, equals == std::string::npos ? "" : variable.substr(equals + 1));
  }
  return values;
}

Status ApplyKeyValues(const KeyValues& values, const std::string& source, ServerConfig& config) {
  Status bad = InvalidArgument("bad configuration in " + source).WithReason("BAD_CONFIG");
  for (const auto& [key, text] : values) SetOne(key, text, config, bad);
  return bad.violations().empty() ? Status::Ok() : bad;
}

std::string ToYaml(const ServerConfig& config) {
  NestedWriter writer;
  const auto write = [&writer](const std::string& prefix) {
    return [&writer, prefix](const char* key, const auto& value, double, double, const char* help) {
      writer.Write(prefix + key, Format(value), help);
    };
  };
  VisitServerFields(config, write(""));
  VisitFields(config.map_defaults, write(std::string(kMapDefaults)));
  return writer.text();
}

}  // namespace dhpmap
