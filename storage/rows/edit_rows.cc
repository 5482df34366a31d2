// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/edit_rows.h"

namespace dhpmap {

const Table<EditRow>& Edits() {
  static const Table<EditRow> table("edits", EditColumns());
  return table;
}

const Table<EditHistoryRow>& EditHistories() {
  static const Table<EditHistoryRow> table("edit_histories", EditHistoryColumns());
  return table;
}

}  // namespace dhpmap
