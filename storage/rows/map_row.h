// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "mapping/map/map.h"
#include "storage/commit/tile_totals.h"
#include "storage/rows/table.h"
#include "storage/store.h"

namespace dhpmap {

/// A row of table maps.
struct MapRow {
  std::int64_t key = 0;
  MapInfo info;
  std::int64_t num_submaps = 0;
  std::uint32_t config_checksum = 0;
  std::uint32_t classes_checksum = 0;
  NumberMarks marks;
  std::uint32_t sessions_checksum = 0;
  TileTotals tiles;  ///< of the map's own layers
  std::uint32_t merged_checksum = 0;
  std::uint32_t pairs_checksum = 0;
  std::uint32_t kept_clear_checksum = 0;
  std::int64_t leaving_id = -1;  ///< the submap that the last edit moved, if its old place is still to be written
  RowSeal seal;

  /// Nothing for -1 and for invalid ids.
  [[nodiscard]] std::optional<SubmapId> leaving() const {
    const bool is_id = leaving_id >= 0 && leaving_id <= std::numeric_limits<std::uint32_t>::max();
    return is_id ? std::optional(SubmapId(static_cast<std::uint32_t>(leaving_id))) : std::nullopt;
  }

  /// Whether it has a sum of its rows in tiles; rows of schema 6 and before only have their number.
  [[nodiscard]] bool CoversTiles() const { return seal.version >= 6; }
};

/// The columns of table maps. `Row` is a MapRow, or derived from it. The order of columns that a released checksum
/// version covers is frozen: new ones go to the end.
template <typename Row = MapRow>
std::vector<Column<Row>> MapColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kElsewhere, 0, DHPMAP_MEMBER(key)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("name", kOnce, 1, DHPMAP_MEMBER(info.name)),
      MakeColumn<Row>("display_name", kAlways, 1, DHPMAP_MEMBER(info.display_name)),
      MakeColumn<Row>("revision", kAlways, 1, DHPMAP_MEMBER(info.revision)),
      MakeColumn<Row>("num_frames", kAlways, 1, DHPMAP_MEMBER(info.num_frames)),
      MakeColumn<Row>("next_submap_id", kAlways, 1, DHPMAP_MEMBER(info.next_submap_id)),
      MakeColumn<Row>("create_time_ns", kOnce, 1, DHPMAP_MEMBER(info.create_time_ns)),
      MakeColumn<Row>("update_time_ns", kAlways, 1, DHPMAP_MEMBER(info.update_time_ns)),
      MakeColumn<Row>("num_submaps", kAlways, 1, DHPMAP_MEMBER(num_submaps)),
      MakeColumn<Row>("config_checksum", kAlways, 2, DHPMAP_MEMBER(config_checksum)),
      MakeColumn<Row>("classes_checksum", kAlways, 2, DHPMAP_MEMBER(classes_checksum)),
      MakeColumn<Row>("revision_mark", kAlways, 2, DHPMAP_MEMBER(marks.revision)),
      MakeColumn<Row>("submap_id_mark", kAlways, 2, DHPMAP_MEMBER(marks.next_submap_id)),
      MakeColumn<Row>("sessions_checksum", kAlways, 3, DHPMAP_MEMBER(sessions_checksum)),
      MakeColumn<Row>("history_id", kAlways, 3, DHPMAP_MEMBER(info.history_id)),
      MakeColumn<Row>("num_tiles", kAlways, 4, DHPMAP_MEMBER(tiles.num_rows)),
      MakeColumn<Row>("tile_bytes", kAlways, 0, DHPMAP_MEMBER(tiles.bytes)),
      MakeColumn<Row>("merged_checksum", kAlways, 5, DHPMAP_MEMBER(merged_checksum)),
      MakeColumn<Row>("pairs_checksum", kAlways, 5, DHPMAP_MEMBER(pairs_checksum)),
      MakeColumn<Row>("tiles_sum", kAlways, 6, DHPMAP_MEMBER(tiles.sum)),
      MakeColumn<Row>("kept_clear_checksum", kAlways, 7, DHPMAP_MEMBER(kept_clear_checksum)),
      MakeColumn<Row>("leaving_submap_id", kAlways, 8, DHPMAP_MEMBER(leaving_id)),
  };
}
const Table<MapRow>& Maps();

}  // namespace dhpmap
