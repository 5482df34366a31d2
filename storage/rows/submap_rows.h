// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "mapping/map/submap.h"
#include "storage/rows/table.h"
#include "storage/sqlite/database.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {

struct SubmapRow {
  std::int64_t key = 0;
  std::int64_t map_key = 0;
  SubmapInfo info;
  BoundingSphere sphere;
  SubmapCounts counts;
  std::int64_t tiles_sum = 0;  ///< see TileTotals
  RowSeal seal;

  /// Whether it says what its rows in tiles are; those that schema 6 and before sealed only count them.
  [[nodiscard]] bool CoversTiles() const { return seal.version >= 3; }
};

/// The columns of table submaps. `Row` is a SubmapRow, or derived from it. Version 1 of the checksum covers the columns
/// in this very order, so it is never changed: new ones go to the end.
template <typename Row = SubmapRow>
std::vector<Column<Row>> SubmapColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("submap_key", kElsewhere, 0, DHPMAP_MEMBER(key)),
      MakeColumn<Row>("blob_bytes", kAlways, 0, DHPMAP_MEMBER(counts.blob_bytes)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("map_key", kOnce, 1, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("submap_id", kOnce, 1, DHPMAP_MEMBER(info.id)),
      MakeColumn<Row>("panoptic", kAlways, 1, DHPMAP_MEMBER(info.panoptic)),
      MakeColumn<Row>("class_id", kAlways, 1, DHPMAP_MEMBER(info.class_id)),
      MakeColumn<Row>("class_is_fixed", kAlways, 1, DHPMAP_MEMBER(info.class_is_fixed)),
      MakeColumn<Row>("activity", kAlways, 1, DHPMAP_MEMBER(info.activity)),
      MakeColumn<Row>("is_confirmed", kAlways, 1, DHPMAP_MEMBER(info.is_confirmed)),
      MakeColumn<Row>("num_frames_observed", kAlways, 1, DHPMAP_MEMBER(info.num_frames_observed)),
      MakeColumn<Row>("num_frames_missed", kAlways, 1, DHPMAP_MEMBER(info.num_frames_missed)),
      MakeColumn<Row>("num_frames_overlooked", kAlways, 1, DHPMAP_MEMBER(info.num_frames_overlooked)),
      MakeColumn<Row>("first_observed_ns", kAlways, 1, DHPMAP_MEMBER(info.first_observed_ns)),
      MakeColumn<Row>("last_observed_ns", kAlways, 1, DHPMAP_MEMBER(info.last_observed_ns)),
      MakeColumn<Row>("track_id", kAlways, 1, DHPMAP_MEMBER(info.track_id)),
      MakeColumn<Row>("revision", kAlways, 1, DHPMAP_MEMBER(info.revision)),
      MakeColumn<Row>("num_tsdf_blocks", kAlways, 1, DHPMAP_MEMBER(counts.num_tsdf_blocks)),
      MakeColumn<Row>("num_label_blocks", kAlways, 1, DHPMAP_MEMBER(counts.num_label_blocks)),
      MakeColumn<Row>("display_name", kAlways, 1, DHPMAP_MEMBER(info.display_name)),
      MakeColumn<Row>("pose", kAlways, 1, DHPMAP_MEMBER(info.T_map_submap)),
      MakeColumn<Row>("sphere", kAlways, 1, DHPMAP_MEMBER(sphere)),
      MakeColumn<Row>("voxel_size_m", kAlways, 1, DHPMAP_MEMBER(info.voxel_size_m)),
      MakeColumn<Row>("truncation_m", kAlways, 1, DHPMAP_MEMBER(info.truncation_m)),
      MakeColumn<Row>("instance_confidence", kAlways, 1, DHPMAP_MEMBER(info.instance_confidence)),
      MakeColumn<Row>("class_counts", kAlways, 1, DHPMAP_MEMBER(info.class_counts)),
      MakeColumn<Row>("num_gone_blocks", kAlways, 2, DHPMAP_MEMBER(counts.num_gone_blocks)),
      MakeColumn<Row>("presence", kAlways, 2, DHPMAP_MEMBER(info.presence)),
      MakeColumn<Row>("last_contradicted_ns", kAlways, 2, DHPMAP_MEMBER(info.last_contradicted_ns)),
      MakeColumn<Row>("is_placed", kAlways, 2, DHPMAP_MEMBER(info.is_placed)),
      MakeColumn<Row>("tiles_sum", kAlways, 3, DHPMAP_MEMBER(tiles_sum)),
      MakeColumn<Row>("edited_revision", kAlways, 3, DHPMAP_MEMBER(info.edited_revision)),
      MakeColumn<Row>("sightings", kAlways, 4, DHPMAP_MEMBER(info.sightings)),
      MakeColumn<Row>("is_locked", kAlways, 5, DHPMAP_MEMBER(info.is_locked)),
  };
}
const Table<SubmapRow>& Submaps();

/// The rows of a map, by ascending submap id. DATA_LOSS, naming the submap, where a row does not match its checksum;
/// where `damaged` is not null, such rows are added to it instead.
Result<std::vector<SubmapRow>> ReadSubmaps(sqlite::Database& database, std::int64_t map_key,
                                           std::vector<SubmapRow>* damaged = nullptr);

/// Writes submap rows and their boxes. One for each transaction.
class SubmapRowWriter {
 public:
  static Result<SubmapRowWriter> Prepare(sqlite::Database& database);

  struct Stored {
    std::int64_t key = 0;
    SubmapCounts counts;
    std::int64_t tiles_sum = 0;
    bool covers_tiles = false;  ///< tiles_sum is right
  };
  /// Nothing if the map has no such submap.
  Result<std::optional<Stored>> Find(std::int64_t map_key, SubmapId id);

  /// Adds or replaces a row. Returns its key.
  Result<std::int64_t> Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                             std::int64_t tiles_sum);
  /// Likewise, of a row that was read; its key and seal do not matter.
  Result<std::int64_t> Write(SubmapRow row);
  /// With its tiles.
  Status Erase(std::int64_t submap_key);

 private:
  SubmapRowWriter(sqlite::Statement find, sqlite::Statement upsert, sqlite::Statement erase,
                  sqlite::Statement write_box, sqlite::Statement erase_box);
  Status WriteBox(std::int64_t map_key, std::int64_t submap_key, const BoundingSphere& in_map);
  sqlite::Statement find_, upsert_, erase_, write_box_, erase_box_;
};

}  // namespace dhpmap
