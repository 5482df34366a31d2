// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/resource_names.h"

#include <charconv>

#include "mapping/map/map.h"

namespace dhpmap {
namespace {

constexpr std::string_view kMaps = "maps/";
constexpr std::string_view kSubmaps = "/submaps/";
constexpr std::string_view kEdits = "/edits/";

Status BadName(std::string_view name, std::string_view field, const char* wanted) {
  const std::string shown(name.substr(0, 120));
  return InvalidArgument("'" + shown + "' is not a name of the form " + wanted)
      .WithReason("BAD_NAME")
      .WithViolation(std::string(field), "'" + shown + "' is not of the form " + wanted);
}

}  // namespace

Result<std::string> ParseMapName(std::string_view name, std::string_view field) {
  constexpr const char* kForm = "maps/{map}, {map} 1 to 63 of a-z 0-9 . _ -";
  if (!name.starts_with(kMaps)) return BadName(name, field, kForm);
  std::string map(name.substr(kMaps.size()));
  if (!ValidateMapName(map).ok()) return BadName(name, field, kForm);
  return map;
}

Result<SubmapName> ParseSubmapName(std::string_view name, std::string_view field) {
  constexpr const char* kForm = "maps/{map}/submaps/{instance id}";
  const std::size_t middle = name.find(kSubmaps);
  if (middle == std::string_view::npos) return BadName(name, field, kForm);
  auto map = ParseMapName(name.substr(0, middle), field);
  if (!map.ok()) return BadName(name, field, kForm);
  const std::string_view digits = name.substr(middle + kSubmaps.size());
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), id);
  const bool is_canonical = digits == "0" || (!digits.empty() && digits[0] != '0');
  if (error != std::errc() || end != digits.data() + digits.size() || !is_canonical) {
    return BadName(name, field, kForm);
  }
  return SubmapName{.map = std::move(*map), .submap = SubmapId(id)};
}

std::string MapOfResource(std::string_view name) {
  if (!name.starts_with(kMaps)) return {};
  name.remove_prefix(kMaps.size());
  return std::string(name.substr(0, name.find('/')));
}

Result<EditName> ParseEditName(std::string_view name, std::string_view field) {
  constexpr const char* kForm = "maps/{map}/edits/{revision}";
  const std::size_t middle = name.find(kEdits);
  if (middle == std::string_view::npos) return BadName(name, field, kForm);
  auto map = ParseMapName(name.substr(0, middle), field);
  if (!map.ok()) return BadName(name, field, kForm);
  const std::string_view digits = name.substr(middle + kEdits.size());
  EditName parsed{.map = std::move(*map)};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), parsed.revision);
  if (error != std::errc() || end != digits.data() + digits.size() || parsed.revision < 1 || digits[0] == '0') {
    return BadName(name, field, kForm);
  }
  return parsed;
}

Result<ObjectName> ParseObjectName(std::string_view name, std::string_view field) {
  if (name.find(kSubmaps) == std::string_view::npos) {
    DHPMAP_ASSIGN_OR_RETURN(std::string map, ParseMapName(name, field));
    return ObjectName{.map = std::move(map), .submap = std::nullopt};
  }
  DHPMAP_ASSIGN_OR_RETURN(SubmapName submap, ParseSubmapName(name, field));
  return ObjectName{.map = std::move(submap.map), .submap = submap.submap};
}

std::string MapResourceName(std::string_view map) { return std::string(kMaps) += map; }

std::string SubmapResourceName(std::string_view map, SubmapId submap) {
  return MapResourceName(map) + std::string(kSubmaps) + std::to_string(submap.value);
}

std::string SessionResourceName(std::string_view map, std::string_view session) {
  return MapResourceName(map) + "/sessions/" + std::string(session);
}

std::string EditResourceName(std::string_view map, std::int64_t revision) {
  return MapResourceName(map) + std::string(kEdits) + std::to_string(revision);
}

}  // namespace dhpmap
