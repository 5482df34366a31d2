// SPDX-License-Identifier: BSD-3-Clause
#include "storage/check/sqlite_rows.h"

#include <utility>

#include "storage/check/sqlite_check.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kVerifyTask[] = "verify the map";

}  // namespace

Result<MapRow> SqliteRows::ReadMapRow() {
  DHPMAP_ASSIGN_OR_RETURN(MapRow map, ReadMap(database_, name_));
  map_key_ = map.key;
  history_.emplace(database_, map_key_);
  return map;
}

Result<std::vector<SubmapRow>> SqliteRows::ReadSubmapRows(std::vector<SubmapRow>& damaged) {
  return ReadSubmaps(database_, map_key_, &damaged);
}

std::int64_t SqliteRows::OwnerOfMapTiles() const { return OwnerOfMap(map_key_); }

Status SqliteRows::ForEachTile(std::int64_t owner_key, const VisitTile& visit) {
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database_));
  return rows.ForEach(owner_key, visit);
}

Result<std::string> SqliteRows::ProblemOfBounds(const SubmapRow& submap) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database_.Prepare("SELECT min_x_m, max_x_m, min_y_m, max_y_m, min_z_m, "
                                                              "max_z_m FROM submap_boxes WHERE submap_key = ?",
                                                              kVerifyTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_box, select.Bind(submap.key).Step());
  if (has_box == submap.sphere.IsEmpty()) return std::string(has_box ? "has a box, but no sphere" : "has no box");
  if (!has_box) return std::string();
  const Eigen::Vector3d center_m = submap.info.T_map_submap * submap.sphere.center_m;
  for (int axis = 0; axis < 3; ++axis) {
    if (select.Real(2 * axis) <= center_m[axis] - submap.sphere.radius_m &&
        select.Real(2 * axis + 1) >= center_m[axis] + submap.sphere.radius_m) {
      continue;
    }
    return std::string("its box does not contain its sphere");
  }
  return std::string();
}

/// Of all maps. Blobs that are noted as dead belong to nothing by right.
Status SqliteRows::ForEachStray(const VisitStray& visit) {
  struct Question {
    const char* sql;  ///< a number a fault, and what belongs before and after it
    const char *before, *after;
  };
  constexpr Question kQuestions[] = {
      {"SELECT blob_key FROM tile_blobs EXCEPT SELECT blob_key FROM blob_references EXCEPT SELECT blob_key FROM "
       "dead_blobs",
       "blob ", " belongs to nothing"},
      {"SELECT blob_key FROM (SELECT blob_key, count(*) - 1 FROM blob_references GROUP BY blob_key HAVING count(*) > "
       "1 EXCEPT SELECT blob_key, num_more FROM shared_blobs) UNION SELECT blob_key FROM (SELECT blob_key, num_more "
       "FROM shared_blobs EXCEPT SELECT blob_key, count(*) - 1 FROM blob_references GROUP BY blob_key)",
       "blob ", " has a wrong count of what refers to it"},
      {"SELECT blob_key FROM dead_blobs WHERE blob_key IN (SELECT blob_key FROM blob_references)", "blob ",
       " is noted as not needed, but is"},
      {"SELECT owner_key FROM tiles GROUP BY owner_key HAVING NOT EXISTS (SELECT 1 FROM submaps WHERE submap_key = "
       "owner_key) AND NOT EXISTS (SELECT 1 FROM maps WHERE map_key = -owner_key)",
       "the tiles of owner ", " belong to no object and no map"},
      {"SELECT submap_key FROM submap_boxes WHERE submap_key NOT IN (SELECT submap_key FROM submaps)", "the box of ",
       " belongs to no submap"},
      {"SELECT edit_key FROM edit_tiles GROUP BY edit_key HAVING NOT EXISTS (SELECT 1 FROM edit_histories h WHERE "
       "h.edit_key = edit_tiles.edit_key)",
       "the tiles that undo edit row ", " belong to no edit"},
  };
  for (const Question& question : kQuestions) {
    DHPMAP_ASSIGN_OR_RETURN(Statement select, database_.Prepare(question.sql, kVerifyTask));
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
      if (!has_row) break;
      DHPMAP_RETURN_IF_ERROR(visit(question.before + std::to_string(select.Int(0)) + question.after));
    }
  }
  return ForEachOrphan(visit);
}

/// Rows whose map, or edit, is not there.
Status SqliteRows::ForEachOrphan(const VisitStray& visit) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database_.Prepare("SELECT \"table\", \"parent\", count(*) FROM pragma_foreign_key_check GROUP BY 1, 2 ORDER BY "
                        "1, 2",
                        kVerifyTask));
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    DHPMAP_RETURN_IF_ERROR(
        visit(std::to_string(select.Int(2)) + " rows of " + select.Text(0) + " belong to none of " + select.Text(1)));
  }
}

Result<Verification> VerifyRows(Database& database, const std::string& name, VerifyScope scope,
                                const std::stop_token& stop) {
  SqliteRows rows(database, name);
  return Verify(rows, scope, stop);
}

}  // namespace dhpmap
