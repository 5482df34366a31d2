// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "tests/rig/ledger/edit_book.h"

namespace dhpmap::rig {

// What answers say that edits may change.

inline Sight SightOf(const v1::Submap& submap) {
  const v1::Vector3& p = submap.map_from_submap().translation_m();
  return {.display_name = submap.display_name(), .position_m = {p.x(), p.y(), p.z()}, .class_id = submap.class_id()};
}

inline Sight SightOf(const v1::Map& map) { return {.display_name = map.display_name()}; }

/// By instance id.
inline std::map<std::int64_t, Sight> SightsOf(const v1::ListSubmapsResponse& all) {
  std::map<std::int64_t, Sight> sights;
  for (const v1::Submap& submap : all.submaps()) sights[submap.instance_id()] = SightOf(submap);
  return sights;
}

}  // namespace dhpmap::rig
