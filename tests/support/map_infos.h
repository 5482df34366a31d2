// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "mapping/map/map.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// Of a map of the classes of MakeLabelSet, with the defaults for the rest.
inline MapInfo NamedMap(std::string name, int num_things, int num_stuff) {
  MapInfo info;
  info.name = std::move(name);
  info.label_set = MakeLabelSet(num_things, num_stuff);
  return info;
}

/// Of a submap on the map's grid, with the defaults for the rest.
inline SubmapInfo InfoOn(const Map& map, Panoptic panoptic, ClassId class_id) {
  SubmapInfo info;
  info.panoptic = panoptic;
  info.class_id = class_id;
  info.voxel_size_m = map.info().config.voxel_size_m;
  info.truncation_m = map.info().config.truncation_m;
  return info;
}

/// Of a thing that has settled.
inline SubmapInfo SettledThingOn(const Map& map, ClassId class_id) {
  SubmapInfo info = InfoOn(map, Panoptic::kThing, class_id);
  info.activity = Activity::kInactive;
  return info;
}

}  // namespace dhpmap::testing
