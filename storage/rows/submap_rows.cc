// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/submap_rows.h"

#include <string>
#include <utility>

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadSubmapsTask[] = "read the submaps";
constexpr char kWriteSubmapTask[] = "write a submap";

}  // namespace

const Table<SubmapRow>& Submaps() {
  static const Table<SubmapRow> table("submaps", SubmapColumns());
  return table;
}

SubmapRow SubmapRowOf(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts, std::int64_t tiles_sum) {
  SubmapRow row{.map_key = map_key,
                .info = submap.info(),
                .sphere = submap.bounding_sphere(),
                .outline = submap.kept_outline().Find(submap.info().T_map_submap),
                .counts = counts,
                .tiles_sum = tiles_sum,
                .seal = {}};
  row.seal = Submaps().SealOf(row);
  return row;
}

Result<std::vector<SubmapRow>> ReadSubmaps(Database& database, std::int64_t map_key, std::vector<SubmapRow>* damaged) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(Submaps().Select("WHERE map_key = ? ORDER BY submap_id"), kReadSubmapsTask));
  select.Bind(map_key);
  std::vector<SubmapRow> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    SubmapRow row;
    if (!Submaps().Read(select, row) || !Submaps().IsIntact(row, row.seal)) {
      if (damaged != nullptr) {
        damaged->push_back(std::move(row));
        continue;
      }
      return DataLoss("submap " + std::to_string(row.info.id.value) + ": its row has a wrong checksum");
    }
    rows.push_back(std::move(row));
  }
}

SubmapRowWriter::SubmapRowWriter(Statement find, Statement upsert, Statement erase, Statement write_box,
                                 Statement erase_box)
    : find_(std::move(find)),
      upsert_(std::move(upsert)),
      erase_(std::move(erase)),
      write_box_(std::move(write_box)),
      erase_box_(std::move(erase_box)) {}

Result<SubmapRowWriter> SubmapRowWriter::Prepare(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(Statement find,
                          database.Prepare(Submaps().Select("WHERE map_key = ? AND submap_id = ?"), kWriteSubmapTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert,
                          database.Prepare(Submaps().Upsert() + " RETURNING submap_key", kWriteSubmapTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM submaps WHERE submap_key = ?", "delete a submap"));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement write_box,
      database.Prepare("INSERT OR REPLACE INTO submap_boxes (submap_key, min_x_m, max_x_m, "
                       "min_y_m, max_y_m, min_z_m, max_z_m, map_key) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                       kWriteSubmapTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase_box,
                          database.Prepare("DELETE FROM submap_boxes WHERE submap_key = ?", kWriteSubmapTask));
  return SubmapRowWriter(std::move(find), std::move(upsert), std::move(erase), std::move(write_box),
                         std::move(erase_box));
}

Result<std::optional<SubmapRowWriter::Stored>> SubmapRowWriter::Find(std::int64_t map_key, SubmapId id) {
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find_.Bind(map_key).Bind(id.value).Step());
  if (!has_row) return std::optional<Stored>();
  SubmapRow row;
  (void)Submaps().Read(find_, row);  // a damaged row is rewritten, because the state in memory is complete
  find_.Reset();
  return std::optional<Stored>({row.key, row.counts, row.tiles_sum, row.CoversTiles()});
}

Result<std::int64_t> SubmapRowWriter::Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                                            std::int64_t tiles_sum) {
  return Write(SubmapRowOf(map_key, submap, counts, tiles_sum));
}

Result<std::int64_t> SubmapRowWriter::Write(SubmapRow row) {
  row.seal = Submaps().SealOf(row);
  Submaps().BindAll(row, upsert_);
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, upsert_.Step());
  if (!has_row) return Internal("writing a submap gave no key");
  const std::int64_t key = upsert_.Int(0);
  DHPMAP_RETURN_IF_ERROR(upsert_.Run());
  BoundingSphere in_map = row.sphere;
  in_map.center_m = row.info.T_map_submap * in_map.center_m;
  DHPMAP_RETURN_IF_ERROR(WriteBox(row.map_key, key, in_map));
  return key;
}

Status SubmapRowWriter::WriteBox(std::int64_t map_key, std::int64_t submap_key, const BoundingSphere& in_map) {
  if (in_map.IsEmpty()) return erase_box_.Bind(submap_key).Run();
  write_box_.Bind(submap_key);
  for (int axis = 0; axis < 3; ++axis) {
    write_box_.Bind(in_map.center_m[axis] - in_map.radius_m).Bind(in_map.center_m[axis] + in_map.radius_m);
  }
  return write_box_.Bind(map_key).Run();
}

Status SubmapRowWriter::Erase(std::int64_t submap_key) { return erase_.Bind(submap_key).Run(); }

}  // namespace dhpmap
