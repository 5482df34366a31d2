// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/check/rows_to_verify.h"

#include <utility>

#include "storage/postgres/rows/table_text.h"
#include "storage/postgres/tiles/tile_owner.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr char kVerifyTask[] = "verify the map";
const std::string kOwnersTiles =
    "SELECT t.x, t.y, t.z, t.layer, t.blob_key, b.blob_key IS NULL, coalesce(b.num_blocks, 0), t.cells, t.extent, "
    "coalesce(b.blob, '') FROM tiles t LEFT JOIN tile_blobs b ON b.map_key = t.map_key AND b.blob_key = t.blob_key "
    "WHERE "
    "t.map_key = $1 AND t.owner_id = $2 ORDER BY t.x, t.y, t.z, t.layer";

/// A query about map $1 that returns the number of faults, and the words before and after it.
struct Question {
  std::string sql;
  const char *before, *after;
};

/// The blobs that a map's rows refer to, once for each reference.
const char kReferences[] =
    "(SELECT blob_key FROM tiles WHERE map_key = $1 UNION ALL SELECT before_key FROM edit_tiles WHERE map_key = $1 AND "
    "before_key <> 0 UNION ALL SELECT after_key FROM edit_tiles WHERE map_key = $1 AND after_key <> 0) ";

const std::vector<Question>& Questions() {
  static const std::vector<Question> questions = {
      {std::string("SELECT blob_key FROM tile_blobs WHERE map_key = $1 EXCEPT SELECT blob_key FROM ") + kReferences +
           "r EXCEPT SELECT blob_key FROM blob_counts WHERE map_key = $1 ORDER BY 1",
       "blob ", " belongs to nothing"},
      {std::string("SELECT coalesce(r.blob_key, c.blob_key) FROM (SELECT blob_key, count(*) AS n FROM ") + kReferences +
           "all_of_them GROUP BY blob_key) r FULL JOIN (SELECT blob_key, num_refs FROM blob_counts WHERE map_key = $1) "
           "c "
           "ON c.blob_key = r.blob_key WHERE coalesce(r.n, 0) <> coalesce(c.num_refs, 1) ORDER BY 1",
       "blob ", " has a wrong count of what refers to it"},
      {"SELECT DISTINCT owner_id FROM tiles WHERE map_key = $1 AND owner_id >= 0 AND owner_id NOT IN (SELECT submap_id "
       "FROM submaps WHERE map_key = $1) ORDER BY 1",
       "the tiles of submap ", " belong to no object"},
      {"SELECT count(*) FROM tiles t JOIN tile_blobs b ON b.map_key = t.map_key AND b.blob_key = t.blob_key WHERE "
       "t.map_key = $1 AND (t.num_bytes <> octet_length(b.blob) OR (t.owner_id >= 0 AND t.cells = 0)) HAVING count(*) "
       "> "
       "0",
       "", " rows of tiles do not say what their blobs are"},  // commits rely on them
      {"SELECT edit_key FROM edit_histories h WHERE map_key = $1 AND NOT EXISTS (SELECT 1 FROM edits e WHERE e.map_key "
       "= "
       "h.map_key AND e.revision = h.edit_key) ORDER BY 1",
       "what undoes edit ", " belongs to no edit"},
      {"SELECT DISTINCT edit_key FROM edit_tiles t WHERE map_key = $1 AND NOT EXISTS (SELECT 1 FROM edit_histories h "
       "WHERE h.map_key = t.map_key AND h.edit_key = t.edit_key) ORDER BY 1",
       "the tiles that undo edit ", " belong to no edit"},
      {"SELECT count(*) FROM (SELECT map_key FROM map_config UNION SELECT map_key FROM submaps) k WHERE $1 <> 0 AND "
       "NOT "
       "EXISTS (SELECT 1 FROM maps m WHERE m.map_key = k.map_key) AND NOT EXISTS (SELECT 1 FROM removed_maps m WHERE "
       "m.map_key = k.map_key) AND NOT EXISTS (SELECT 1 FROM incoming_maps m WHERE m.map_key = k.map_key) HAVING "
       "count(*) > 0",
       "rows of ", " maps belong to no map"},
  };
  return questions;
}

TileRow TileToVerify(Answer& answer) {
  TileRow row;
  for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) *axis = static_cast<std::int32_t>(answer.Int());
  row.layer = answer.Int();
  row.blob_key = answer.Int();
  row.is_missing = answer.Int() != 0;
  row.num_blocks = answer.Int();
  row.cells = static_cast<std::uint64_t>(answer.Int());
  row.extent = static_cast<std::uint64_t>(answer.Int());
  row.blob = answer.Blob();
  return row;
}

}  // namespace

Result<MapRow> RowsToVerify::ReadMapRow() {
  DHPMAP_ASSIGN_OR_RETURN(map_, ReadNamedMap(connection_, name_));
  history_.emplace(connection_, map_.head.row.key);
  return map_.head.row;
}

Result<std::vector<SubmapRow>> RowsToVerify::ReadSubmapRows(std::vector<SubmapRow>& damaged) {
  static const std::string text = SelectText(Submaps(), "WHERE map_key = $1 ORDER BY submap_id");
  Call call{&text};
  call.values.Add(map_.head.row.key);
  std::vector<SubmapRow> rows;
  DHPMAP_RETURN_IF_ERROR(connection_.Stream(call, kVerifyTask, [&](Answer& answer) {
    SubmapRow row;
    const bool is_intact = ReadRow(Submaps(), answer, row) && Submaps().IsIntact(row, row.seal);
    row.key = row.info.id.value;
    (is_intact ? rows : damaged).push_back(std::move(row));
    return Status::Ok();
  }));
  return rows;
}

std::int64_t RowsToVerify::OwnerOfMapTiles() const { return kMapsOwner; }

Status RowsToVerify::ForEachTile(std::int64_t owner_key, const VisitTile& visit) {
  Call call{&kOwnersTiles};
  call.values.Add(map_.head.row.key).Add(owner_key);
  return connection_.Stream(call, kVerifyTask, [&visit](Answer& answer) { return visit(TileToVerify(answer)); });
}

Status RowsToVerify::ForEachStray(const VisitStray& visit) {
  for (const Question& question : Questions()) {
    Call call{&question.sql};
    call.values.Add(map_.head.row.key);
    DHPMAP_RETURN_IF_ERROR(connection_.Stream(call, kVerifyTask, [&](Answer& answer) {
      return visit(question.before + std::to_string(answer.Int()) + question.after);
    }));
  }
  return Status::Ok();
}

}  // namespace dhpmap::postgres
