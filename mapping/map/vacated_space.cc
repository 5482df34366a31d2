// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/vacated_space.h"

#include "mapping/map/left_space.h"
#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

MovedAway StateOf(const Submap& moved, const Map& map) {
  return {moved, map.submaps(), map.info().config, map.free_space()};
}

}  // namespace

void NoteVacated(const Submap& leaving, Map& map) {
  if (!IsExclusive(leaving.info(), map.info().config)) return;
  FreeSpace& vacated = map.mutable_vacated();
  AddLeft(StateOf(leaving, map), vacated);
}

void TakeVacatedBack(const Submap& back, Map& map) {
  if (!IsExclusive(back.info(), map.info().config)) return;
  FreeSpace& vacated = map.mutable_vacated();
  TakeLeft(StateOf(back, map), vacated);
}

}  // namespace dhpmap
