// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "storage/store.h"
#include "tests/unit/storage/kept_store.h"

namespace dhpmap::testing {

using FaultKind = MapFault::Kind;

/// What is done to map "house" behind the store's back, and what a verification says of it.
struct VerifyCase {
  std::string damage;
  FaultKind kind;
  const char* place;  ///< begins so
};

/// HOUSE is the key of the map.
inline std::string WithHouse(std::string sql) {
  const std::string word = "HOUSE", key = "(SELECT m.map_key FROM maps m WHERE m.name = 'house')";
  for (std::size_t at = sql.find(word); at != std::string::npos; at = sql.find(word, at + key.size())) {
    sql.replace(at, word.size(), key);
  }
  return sql;
}

inline const std::vector<VerifyCase>& VerifyCasesOfSqlite() {
  static const std::vector<VerifyCase> cases = {
      {"UPDATE tile_blobs SET blob = CAST(substr(blob, 1, 30) || x'5A' || substr(blob, 32) AS BLOB) WHERE blob_key = "
       "(SELECT min(blob_key) FROM tiles WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key "
       "= "
       "1 AND submap_id = 3))",
       FaultKind::kBlob, "submap 3: tsdf tile ("},
      {"DELETE FROM tile_blobs WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE layer = 2 AND owner_key = "
       "(SELECT "
       "submap_key FROM submaps WHERE map_key = 1 AND submap_id = 1))",
       FaultKind::kBlob, "submap 1: label tile ("},
      {"UPDATE tile_blobs SET blob = x'00' WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE owner_key = -1)",
       FaultKind::kBlob, "free-space tile ("},
      {"UPDATE submaps SET track_id = track_id + 1 WHERE map_key = 1 AND submap_id = 3", FaultKind::kRow, "submap 3"},
      {"DELETE FROM submaps WHERE map_key = 1 AND submap_id = 3", FaultKind::kCount, "map"},
      {"DELETE FROM tiles WHERE layer = 4 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND "
       "submap_id = 1)",
       FaultKind::kCount, "submap 1"},
      {"UPDATE tiles SET cells = -1 WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 "
       "AND submap_id = 1)",
       FaultKind::kCount, "submap 1: tsdf tile ("},
      {"UPDATE tiles SET extent = extent - (1 << 7) WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps "
       "WHERE map_key = 1 "
       "AND submap_id = 1)",
       FaultKind::kCount, "submap 1: tsdf tile ("},
      {"DELETE FROM tiles WHERE owner_key = -1 AND layer = 5", FaultKind::kCount, "map"},
      {"UPDATE submap_boxes SET max_x_m = min_x_m WHERE submap_key = (SELECT submap_key FROM submaps WHERE map_key = 1 "
       "AND submap_id = 1)",
       FaultKind::kBounds, "submap 1"},
      {"INSERT INTO tile_blobs (num_blocks, blob) VALUES (1, x'00')", FaultKind::kReference, "database"},
      {"DELETE FROM shared_blobs", FaultKind::kReference, "database"},
      {"UPDATE tile_blobs SET num_blocks = num_blocks + 1 WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE "
       "layer = "
       "1)",
       FaultKind::kCount, "submap "},
      {"DELETE FROM submap_boxes WHERE submap_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND submap_id = "
       "1)",
       FaultKind::kBounds, "submap 1"},
      {"INSERT INTO submap_boxes VALUES (999, 0, 1, 0, 1, 0, 1, 1)", FaultKind::kReference, "database"},
      {"UPDATE shared_blobs SET num_more = num_more + 1", FaultKind::kReference, "database"},
      {"INSERT INTO tiles SELECT 999, x, y, z, layer, blob_key, cells, extent FROM tiles WHERE owner_key = -1",
       FaultKind::kReference, "database"},
      {"INSERT INTO map_config VALUES (77, 'voxel_size_m', '1')", FaultKind::kReference, "database"},
      {"DELETE FROM edits WHERE request_id = 'abc'", FaultKind::kReference, "database"},
      {"UPDATE edits SET author = 'eve' WHERE author = 'ben'", FaultKind::kRow, "edit "},
      {"UPDATE edits SET answer = x'00' WHERE request_id = 'abc'", FaultKind::kRow, "edit "},
      {"UPDATE edit_histories SET num_bytes = num_bytes + 1", FaultKind::kRow, "what undoes edit "},
      {"UPDATE edit_histories SET tiles_sum = 5", FaultKind::kRow, "what undoes edit "},
      {"DELETE FROM edit_tiles WHERE layer = 1", FaultKind::kCount, "what undoes edit "},
      {"UPDATE edit_tiles SET submap_id = 9 WHERE layer = 1", FaultKind::kReference, "edit "},
      {"INSERT INTO edit_tiles SELECT 999, submap_id, x, y, z, layer, before_key, after_key FROM edit_tiles",
       FaultKind::kReference, "database"},
      {"DELETE FROM tile_blobs WHERE blob_key = (SELECT max(before_key) FROM edit_tiles WHERE before_key NOT IN "
       "(SELECT blob_key FROM tiles))",
       FaultKind::kBlob, "edit "},
      {"UPDATE tile_blobs SET blob = x'00' WHERE blob_key = (SELECT max(before_key) FROM edit_tiles WHERE before_key "
       "NOT IN (SELECT blob_key FROM tiles))",
       FaultKind::kBlob, "edit "},
      {"DELETE FROM edit_targets", FaultKind::kReference, "edit "},
      {"INSERT INTO edit_targets VALUES (1, 999, 1000, 1)", FaultKind::kReference, "edit 1000"},
      {"UPDATE edit_totals SET num_edits = num_edits + 1", FaultKind::kCount, "edits"},
      {"UPDATE edit_totals SET history_bytes = 0", FaultKind::kCount, "edits"},
      {"DELETE FROM edit_totals", FaultKind::kCount, "edits"},
      {"UPDATE changes SET time_ns = time_ns + 1 WHERE map_key = 1", FaultKind::kRow, "change of revision "},
      {"UPDATE changes SET blob = x'00' WHERE map_key = 1", FaultKind::kRow, "change of revision "},
      {"DELETE FROM changes WHERE change_key = (SELECT max(change_key) FROM changes WHERE map_key = 1)",
       FaultKind::kCount, "changes"},
      {"DELETE FROM changes WHERE change_key = (SELECT max(change_key) - 1 FROM changes WHERE map_key = 1)",
       FaultKind::kCount, "changes"},
      {"UPDATE change_logs SET num_bytes = 1 WHERE map_key = 1", FaultKind::kRow, "changes"},
  };
  return cases;
}

inline const std::vector<VerifyCase>& VerifyCasesOfPostgres() {
  static const std::vector<VerifyCase> cases = {
      {"UPDATE tile_blobs SET blob = overlay(blob placing x'5A' from 31) WHERE map_key = HOUSE AND blob_key = (SELECT "
       "min(blob_key) FROM tiles WHERE map_key = HOUSE AND layer = 1 AND owner_id = 3)",
       FaultKind::kBlob, "submap 3: tsdf tile ("},
      {"DELETE FROM tile_blobs WHERE map_key = HOUSE AND blob_key = (SELECT min(blob_key) FROM tiles WHERE map_key = "
       "HOUSE AND layer = 2 AND owner_id = 1)",
       FaultKind::kBlob, "submap 1: label tile ("},
      {"UPDATE tile_blobs SET blob = x'00' WHERE map_key = HOUSE AND blob_key = (SELECT min(blob_key) FROM tiles WHERE "
       "map_key = HOUSE AND owner_id = -1)",
       FaultKind::kBlob, "free-space tile ("},
      {"UPDATE submaps SET track_id = track_id + 1 WHERE map_key = HOUSE AND submap_id = 3", FaultKind::kRow,
       "submap 3"},
      {"DELETE FROM submaps WHERE map_key = HOUSE AND submap_id = 3", FaultKind::kCount, "map"},
      {"DELETE FROM submaps WHERE map_key = HOUSE AND submap_id = 3", FaultKind::kReference, "database"},
      {"DELETE FROM tiles WHERE map_key = HOUSE AND layer = 4 AND owner_id = 1", FaultKind::kCount, "submap 1"},
      {"UPDATE tiles SET cells = -1 WHERE map_key = HOUSE AND layer = 1 AND owner_id = 1", FaultKind::kCount,
       "submap 1: tsdf tile ("},
      {"UPDATE tiles SET extent = extent - (1 << 7) WHERE map_key = HOUSE AND layer = 1 AND owner_id = 1",
       FaultKind::kCount, "submap 1: tsdf tile ("},
      {"UPDATE tiles SET cells = 0 WHERE map_key = HOUSE AND owner_id = 1", FaultKind::kReference, "database"},
      {"UPDATE tiles SET num_bytes = num_bytes + 1 WHERE map_key = HOUSE", FaultKind::kReference, "database"},
      {"DELETE FROM tiles WHERE map_key = HOUSE AND owner_id = -1 AND layer = 5", FaultKind::kCount, "map"},
      {"INSERT INTO tile_blobs VALUES (HOUSE, 700001, 1, x'00')", FaultKind::kReference, "database"},
      {"DELETE FROM blob_counts WHERE map_key = HOUSE", FaultKind::kReference, "database"},
      {"UPDATE blob_counts SET num_refs = num_refs + 1", FaultKind::kReference, "database"},
      {"UPDATE tile_blobs SET num_blocks = num_blocks + 1 WHERE map_key = HOUSE AND blob_key = (SELECT min(blob_key) "
       "FROM tiles WHERE map_key = HOUSE AND layer = 1)",
       FaultKind::kCount, "submap "},
      {"INSERT INTO tiles (map_key, owner_id, x, y, z, layer, num_bytes, blob_key, cells, extent) SELECT map_key, 999, "
       "x, y, z, layer, num_bytes, blob_key, cells, extent FROM tiles WHERE map_key = HOUSE AND owner_id = -1",
       FaultKind::kReference, "database"},
      {"INSERT INTO map_config VALUES (77, 'voxel_size_m', '1')", FaultKind::kReference, "database"},
      {"DELETE FROM edits WHERE request_id = 'abc'", FaultKind::kReference, "database"},
      {"UPDATE edits SET author = 'eve' WHERE author = 'ben'", FaultKind::kRow, "edit "},
      {"UPDATE edits SET answer = x'00' WHERE request_id = 'abc'", FaultKind::kRow, "edit "},
      {"UPDATE edit_histories SET num_bytes = num_bytes + 1", FaultKind::kRow, "what undoes edit "},
      {"UPDATE edit_histories SET tiles_sum = 5", FaultKind::kRow, "what undoes edit "},
      {"DELETE FROM edit_tiles WHERE layer = 1", FaultKind::kCount, "what undoes edit "},
      {"UPDATE edit_tiles SET submap_id = 9 WHERE layer = 1", FaultKind::kReference, "edit "},
      {"INSERT INTO edit_tiles (map_key, edit_key, submap_id, x, y, z, layer, before_key, after_key) SELECT map_key, "
       "999, "
       "submap_id, x, y, z, layer, before_key, after_key FROM edit_tiles",
       FaultKind::kReference, "database"},
      {"DELETE FROM tile_blobs WHERE map_key = HOUSE AND blob_key = (SELECT max(before_key) FROM edit_tiles WHERE "
       "before_key NOT IN (SELECT blob_key FROM tiles WHERE map_key = HOUSE))",
       FaultKind::kBlob, "edit "},
      {"UPDATE tile_blobs SET blob = x'00' WHERE map_key = HOUSE AND blob_key = (SELECT max(before_key) FROM "
       "edit_tiles "
       "WHERE before_key NOT IN (SELECT blob_key FROM tiles WHERE map_key = HOUSE))",
       FaultKind::kBlob, "edit "},
      {"DELETE FROM edit_targets", FaultKind::kReference, "edit "},
      {"INSERT INTO edit_targets VALUES (HOUSE, 999, 1000, 1)", FaultKind::kReference, "edit 1000"},
      {"UPDATE edit_totals SET num_edits = num_edits + 1", FaultKind::kCount, "edits"},
      {"UPDATE edit_totals SET history_bytes = 0", FaultKind::kCount, "edits"},
      {"DELETE FROM edit_totals", FaultKind::kCount, "edits"},
      {"UPDATE changes SET time_ns = time_ns + 1 WHERE map_key = HOUSE", FaultKind::kRow, "change of revision "},
      {"UPDATE changes SET blob = x'00' WHERE map_key = HOUSE", FaultKind::kRow, "change of revision "},
      {"DELETE FROM changes WHERE map_key = HOUSE AND last_revision = (SELECT max(last_revision) FROM changes WHERE "
       "map_key = HOUSE)",
       FaultKind::kCount, "changes"},
      {"DELETE FROM changes WHERE map_key = HOUSE AND last_revision = (SELECT max(last_revision) - 1 FROM changes "
       "WHERE "
       "map_key = HOUSE)",
       FaultKind::kCount, "changes"},
      {"UPDATE change_logs SET num_bytes = 1 WHERE map_key = HOUSE", FaultKind::kRow, "changes"},
  };
  return cases;
}

inline std::vector<VerifyCase> VerifyCasesOf(StoreKind kind) {
  std::vector<VerifyCase> cases = kind == StoreKind::kPostgres ? VerifyCasesOfPostgres() : VerifyCasesOfSqlite();
  for (VerifyCase& one : cases) one.damage = WithHouse(one.damage);
  return cases;
}

}  // namespace dhpmap::testing
