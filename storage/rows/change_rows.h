// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "storage/codec/bytes.h"
#include "storage/rows/table.h"

namespace dhpmap {

namespace sqlite {
class Database;
}

// Rows of changes and change_logs. Each has its own checksum: the map is complete without them.

/// Bytes as they are in a column.
struct ChangeBlob {
  Bytes bytes;
};
inline Bytes ToBytes(const ChangeBlob& blob) { return blob.bytes; }
inline bool FromBytes(ByteView bytes, ChangeBlob& blob) {
  blob.bytes.assign(bytes.begin(), bytes.end());
  return true;
}

/// The change of one commit.
struct ChangeRow {
  std::int64_t key = 0;
  std::int64_t map_key = 0;
  std::int64_t last_revision = 0;
  std::int64_t first_revision = 0;
  std::int64_t previous_revision = 0;  ///< last_revision of the previous change, or where the log began
  std::int64_t time_ns = 0;
  ChangeBlob blob;
  std::int64_t seen_ns = 0;  ///< time of SeenClock
  RowSeal seal;
};

/// The columns of table changes.
template <typename Row = ChangeRow>
std::vector<Column<Row>> ChangeColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("change_key", kElsewhere, 0, DHPMAP_MEMBER(key)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("map_key", kOnce, 1, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("last_revision", kOnce, 1, DHPMAP_MEMBER(last_revision)),
      MakeColumn<Row>("first_revision", kAlways, 1, DHPMAP_MEMBER(first_revision)),
      MakeColumn<Row>("previous_revision", kAlways, 1, DHPMAP_MEMBER(previous_revision)),
      MakeColumn<Row>("time_ns", kAlways, 1, DHPMAP_MEMBER(time_ns)),
      MakeColumn<Row>("blob", kAlways, 1, DHPMAP_MEMBER(blob)),
      MakeColumn<Row>("seen_ns", kAlways, 2, DHPMAP_MEMBER(seen_ns)),
  };
}
const Table<ChangeRow>& Changes();

/// How far the changes of a map go back.
struct ChangeLogRow {
  std::int64_t map_key = 0;
  std::uint64_t history_id = 0;     ///< of the map when it was written
  std::int64_t complete_after = 0;  ///< changes of all later revisions are kept
  std::int64_t last_revision = 0;   ///< of the last change, or where the log began
  std::int64_t num_changes = 0;
  std::int64_t num_bytes = 0;  ///< of their blobs
  RowSeal seal;
};

/// The columns of table change_logs.
template <typename Row = ChangeLogRow>
std::vector<Column<Row>> ChangeLogColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kOnce, 1, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("history_id", kAlways, 1, DHPMAP_MEMBER(history_id)),
      MakeColumn<Row>("complete_after", kAlways, 1, DHPMAP_MEMBER(complete_after)),
      MakeColumn<Row>("last_revision", kAlways, 1, DHPMAP_MEMBER(last_revision)),
      MakeColumn<Row>("num_changes", kAlways, 1, DHPMAP_MEMBER(num_changes)),
      MakeColumn<Row>("num_bytes", kAlways, 1, DHPMAP_MEMBER(num_bytes)),
  };
}
const Table<ChangeLogRow>& ChangeLogs();

/// Nothing if there is no log. DATA_LOSS if it is damaged.
Result<std::optional<ChangeLogRow>> ReadChangeLog(sqlite::Database& database, std::int64_t map_key);

}  // namespace dhpmap
