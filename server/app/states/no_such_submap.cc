// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/no_such_submap.h"

#include <optional>
#include <string>

namespace dhpmap {

Status NoSuchSubmap(const MapInfo& map, SubmapId id) {
  const std::string which = "submap " + std::to_string(id.value);
  const std::optional<SubmapId> into = map.merged.Into(id);
  if (!into) return NotFound(which + " does not exist").WithReason("SUBMAP_NOT_FOUND");
  const std::string other = "maps/" + map.name + "/submaps/" + std::to_string(into->value);
  return NotFound(which + " is a part of " + other + " now")
      .WithReason("MERGED_INTO")
      .WithMetadata("merged_into", other);
}

}  // namespace dhpmap
