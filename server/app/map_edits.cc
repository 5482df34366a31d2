// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_edits.h"

#include "server/app/etag.h"

namespace dhpmap {

Status PatchMap(Map& map, const std::string& etag, const MapPatch& patch) {
  DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, EtagOf(map.info()), "map '" + map.info().name + "'"));
  if (!patch.display_name || *patch.display_name == map.info().display_name) return Status::Ok();
  if (patch.display_name->size() > kMaxDisplayNameBytes) {
    Status bad = InvalidArgument("the map cannot be changed like this").WithReason("BAD_EDIT");
    bad.AddViolation("display_name", "is longer than " + std::to_string(kMaxDisplayNameBytes) + " bytes");
    return bad;
  }
  map.mutable_info().display_name = *patch.display_name;
  return Status::Ok();
}

}  // namespace dhpmap
