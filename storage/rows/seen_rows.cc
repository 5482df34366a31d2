// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/seen_rows.h"

namespace dhpmap {

const Table<SeenRow>& SeenTable() {
  static const Table<SeenRow> table("seen_time", SeenColumns());
  return table;
}

}  // namespace dhpmap
