// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/map/edit_entry.h"
#include "storage/rows/change_rows.h"
#include "storage/rows/table.h"

namespace dhpmap {

// Rows of edits and edit_histories. Each has its own checksum: the map is complete without them.

/// An edit in the log.
struct EditRow {
  std::int64_t key = 0;
  std::int64_t map_key = 0;
  std::int64_t revision = 0;
  std::int64_t time_ns = 0;
  EditKind kind = EditKind::kEdit;
  EditSource source;
  ChangeBlob summary;
  ChangeBlob answer;         ///< response to its request; empty without a request id
  std::int64_t seen_ns = 0;  ///< time of SeenClock
  RowSeal seal;
};

/// The columns of table edits.
template <typename Row = EditRow>
std::vector<Column<Row>> EditColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("edit_key", kElsewhere, 0, DHPMAP_MEMBER(key)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("map_key", kOnce, 1, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("revision", kOnce, 1, DHPMAP_MEMBER(revision)),
      MakeColumn<Row>("time_ns", kAlways, 1, DHPMAP_MEMBER(time_ns)),
      MakeColumn<Row>("kind", kAlways, 1, DHPMAP_MEMBER(kind)),
      MakeColumn<Row>("author", kAlways, 1, DHPMAP_MEMBER(source.author)),
      MakeColumn<Row>("request_id", kAlways, 1, DHPMAP_MEMBER(source.request_id)),
      MakeColumn<Row>("request_fingerprint", kAlways, 1, DHPMAP_MEMBER(source.request_fingerprint)),
      MakeColumn<Row>("summary", kAlways, 1, DHPMAP_MEMBER(summary)),
      MakeColumn<Row>("answer", kAlways, 1, DHPMAP_MEMBER(answer)),
      MakeColumn<Row>("seen_ns", kAlways, 2, DHPMAP_MEMBER(seen_ns)),
  };
}
const Table<EditRow>& Edits();

/// Undo data of an edit, without its tiles.
struct EditHistoryRow {
  std::int64_t key = 0;  ///< of the edit
  std::int64_t map_key = 0;
  std::int64_t revision = 0;
  std::int64_t time_ns = 0;
  std::int64_t num_bytes = 0;  ///< of all undo data of the edit
  std::int64_t tiles_sum = 0;  ///< over its rows in edit_tiles, see FORMAT.md
  ChangeBlob blob;
  RowSeal seal;
};

/// The columns of table edit_histories.
template <typename Row = EditHistoryRow>
std::vector<Column<Row>> EditHistoryColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("edit_key", kOnce, 0, DHPMAP_MEMBER(key)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("map_key", kAlways, 1, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("revision", kAlways, 1, DHPMAP_MEMBER(revision)),
      MakeColumn<Row>("time_ns", kAlways, 1, DHPMAP_MEMBER(time_ns)),
      MakeColumn<Row>("num_bytes", kAlways, 1, DHPMAP_MEMBER(num_bytes)),
      MakeColumn<Row>("tiles_sum", kAlways, 1, DHPMAP_MEMBER(tiles_sum)),
      MakeColumn<Row>("blob", kAlways, 1, DHPMAP_MEMBER(blob)),
  };
}
const Table<EditHistoryRow>& EditHistories();

}  // namespace dhpmap
