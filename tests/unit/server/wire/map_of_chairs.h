// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mapping/map/map.h"

namespace dhpmap::testing {

inline MapInfo MapOfChairs() {
  MapInfo map;
  map.name = "home";
  map.revision = 5;
  map.label_set = std::make_shared<const LabelSet>(*LabelSet::Create({{.id = ClassId(2), .name = "chair"}}));
  return map;
}

}  // namespace dhpmap::testing
