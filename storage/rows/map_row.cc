// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/map_row.h"

namespace dhpmap {

const Table<MapRow>& Maps() {
  static const Table<MapRow> table("maps", MapColumns());
  return table;
}

}  // namespace dhpmap
