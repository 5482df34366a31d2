// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// instance_id without a submap; 0 is the unknown one.
inline constexpr std::int64_t kNobodysId = -1;
/// class_id without a class, in columns.
inline constexpr std::int32_t kNoClass = -1;

struct SubmapName {
  std::string map;
  SubmapId submap;
};

// Names of the API. A malformed one is INVALID_ARGUMENT with reason BAD_NAME and a violation of `field`.

/// "maps/{map}" -> {map}.
Result<std::string> ParseMapName(std::string_view name, std::string_view field);
/// "maps/{map}/submaps/{instance id in decimal}".
Result<SubmapName> ParseSubmapName(std::string_view name, std::string_view field);

/// A map, or one of its submaps.
struct ObjectName {
  std::string map;
  std::optional<SubmapId> submap;
};
/// Either form.
Result<ObjectName> ParseObjectName(std::string_view name, std::string_view field);

/// {map} of any name below "maps/{map}"; empty for other names.
std::string MapOfResource(std::string_view name);

struct EditName {
  std::string map;
  std::int64_t revision = 0;
};
/// "maps/{map}/edits/{revision in decimal}".
Result<EditName> ParseEditName(std::string_view name, std::string_view field);

std::string MapResourceName(std::string_view map);
std::string SubmapResourceName(std::string_view map, SubmapId submap);
/// An edit is identified by its revision.
std::string EditResourceName(std::string_view map, std::int64_t revision);
/// "maps/{map}/sessions/{session}".
std::string SessionResourceName(std::string_view map, std::string_view session);

}  // namespace dhpmap
