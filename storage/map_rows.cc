// SPDX-License-Identifier: BSD-3-Clause
#include "storage/map_rows.h"

#include <utility>

#include "storage/codec/bytes.h"
#include "storage/codec/crc32c.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadTask[] = "read the map";
constexpr char kWriteTask[] = "write the map";

Status NoSuchMap(const std::string& name) {
  return NotFound("there is no map '" + name + "'").WithReason("NO_SUCH_MAP");
}

Status Damaged(const std::string& name, const std::string& what) {
  return DataLoss("map '" + name + "': " + what).WithReason("DAMAGED_MAP");
}

std::uint32_t ColorCode(Color c) { return (std::uint32_t{c.r} << 16) | (std::uint32_t{c.g} << 8) | c.b; }

Color ColorOf(std::int64_t code) {
  return {static_cast<std::uint8_t>(code >> 16), static_cast<std::uint8_t>(code >> 8), static_cast<std::uint8_t>(code)};
}

std::uint32_t Checksum(const MapInfo& info, std::int64_t num_submaps) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.PutText(info.name);
  writer.PutText(info.display_name);
  for (const std::int64_t value : {info.revision, info.num_frames, std::int64_t{info.next_submap_id.value},
                                   info.create_time_ns, info.update_time_ns, num_submaps}) {
    writer.PutU64(static_cast<std::uint64_t>(value));
  }
  for (const auto& [key, value] : ConfigToText(info.config)) {
    writer.PutText(key);
    writer.PutText(value);
  }
  for (const LabelClass& c : info.label_set->classes()) {
    writer.PutU32(c.id.value);
    writer.PutText(c.name);
    writer.PutU8(static_cast<std::uint8_t>(c.panoptic));
    writer.PutU8(static_cast<std::uint8_t>(c.size));
    writer.PutU32(ColorCode(c.color));
  }
  return Crc32c(bytes);
}

Status WriteConfig(Database& database, std::int64_t map_key, const MapConfig& config) {
  DHPMAP_ASSIGN_OR_RETURN(Statement clear, database.Prepare("DELETE FROM map_config WHERE map_key = ?", kWriteTask));
  DHPMAP_RETURN_IF_ERROR(clear.Bind(map_key).Run());
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, database.Prepare("INSERT INTO map_config VALUES (?, ?, ?)", kWriteTask));
  for (const auto& [key, value] : ConfigToText(config)) {
    DHPMAP_RETURN_IF_ERROR(insert.Bind(map_key).Bind(key).Bind(value).Run());
  }
  return Status::Ok();
}

Status ReadConfig(Database& database, std::int64_t map_key, MapConfig& config) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare("SELECT key, value FROM map_config WHERE map_key = ?", kReadTask));
  select.Bind(map_key);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    if (const Status set = SetField(config, select.Text(0), select.Text(1)); !set.ok()) {
      return FailedPrecondition("the map's config is not of this version: " + set.message()).WithReason("NEWER_CONFIG");
    }
  }
}

Status WriteLabelSet(Database& database, std::int64_t map_key, const LabelSet& label_set) {
  DHPMAP_ASSIGN_OR_RETURN(Statement clear, database.Prepare("DELETE FROM label_classes WHERE map_key = ?", kWriteTask));
  DHPMAP_RETURN_IF_ERROR(clear.Bind(map_key).Run());
  DHPMAP_ASSIGN_OR_RETURN(Statement insert,
                          database.Prepare("INSERT INTO label_classes VALUES (?, ?, ?, ?, ?, ?)", kWriteTask));
  for (const LabelClass& c : label_set.classes()) {
    insert.Bind(map_key).Bind(c.id.value).Bind(c.name).Bind(static_cast<int>(c.panoptic));
    DHPMAP_RETURN_IF_ERROR(insert.Bind(static_cast<int>(c.size)).Bind(ColorCode(c.color)).Run());
  }
  return Status::Ok();
}

Result<std::shared_ptr<const LabelSet>> ReadLabelSet(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT class_id, name, panoptic, size, color_rgb FROM label_classes WHERE map_key = ?",
                       kReadTask));
  select.Bind(map_key);
  std::vector<LabelClass> classes;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    classes.push_back({.id = ClassId(static_cast<std::uint16_t>(select.Int(0))),
                       .name = select.Text(1),
                       .panoptic = static_cast<Panoptic>(select.Int(2)),
                       .size = static_cast<SizeClass>(select.Int(3)),
                       .color = ColorOf(select.Int(4))});
  }
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(std::move(classes)));
  return std::make_shared<const LabelSet>(std::move(label_set));
}

}  // namespace

Result<MapHead> ReadMapHead(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT map_key, revision, create_time_ns FROM maps WHERE name = ?", kReadTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(name).Step());
  if (!has_row) return NoSuchMap(name);
  return MapHead{select.Int(0), select.Int(1), select.Int(2)};
}

Result<MapRow> ReadMap(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT map_key, display_name, revision, num_frames, next_submap_id, create_time_ns, "
                       "update_time_ns, num_submaps, checksum FROM maps WHERE name = ?",
                       kReadTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(name).Step());
  if (!has_row) return NoSuchMap(name);
  MapRow row{.key = select.Int(0), .info = {}, .num_submaps = select.Int(7)};
  row.info.name = name;
  row.info.display_name = select.Text(1);
  row.info.revision = select.Int(2);
  row.info.num_frames = select.Int(3);
  row.info.next_submap_id = SubmapId(static_cast<std::uint32_t>(select.Int(4)));
  row.info.create_time_ns = select.Int(5);
  row.info.update_time_ns = select.Int(6);
  const std::int64_t checksum = select.Int(8);
  DHPMAP_RETURN_IF_ERROR(ReadConfig(database, row.key, row.info.config));
  Result<std::shared_ptr<const LabelSet>> label_set = ReadLabelSet(database, row.key);
  if (!label_set.ok()) return Damaged(name, "its label set is damaged: " + label_set.status().message());
  row.info.label_set = std::move(label_set).value();
  if (Checksum(row.info, row.num_submaps) != checksum) return Damaged(name, "its row has a wrong checksum");
  return row;
}

Result<std::vector<std::string>> ReadMapNames(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT name FROM maps ORDER BY name", "list the maps"));
  std::vector<std::string> names;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return names;
    names.push_back(select.Text(0));
  }
}

Result<std::int64_t> InsertMap(Database& database, const MapSnapshot& snapshot) {
  const MapInfo& info = snapshot.info();
  DHPMAP_ASSIGN_OR_RETURN(
      Statement insert,
      database.Prepare("INSERT INTO maps (name, display_name, revision, num_frames, next_submap_id, create_time_ns, "
                       "update_time_ns, num_submaps, checksum) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                       kWriteTask));
  insert.Bind(info.name).Bind(info.display_name).Bind(info.revision).Bind(info.num_frames);
  insert.Bind(info.next_submap_id.value).Bind(info.create_time_ns).Bind(info.update_time_ns);
  const auto num_submaps = static_cast<std::int64_t>(snapshot.submaps().size());
  const Status inserted = insert.Bind(num_submaps).Bind(Checksum(info, num_submaps)).Run();
  if (inserted.code() == StatusCode::kAlreadyExists) {
    return AlreadyExists("there is already a map '" + info.name + "'").WithReason("MAP_EXISTS");
  }
  DHPMAP_RETURN_IF_ERROR(inserted);
  const std::int64_t map_key = database.LastInsertRowId();
  DHPMAP_RETURN_IF_ERROR(WriteConfig(database, map_key, info.config));
  DHPMAP_RETURN_IF_ERROR(WriteLabelSet(database, map_key, *info.label_set));
  return map_key;
}

Status UpdateMap(Database& database, std::int64_t map_key, const MapInfo& before, const MapSnapshot& after) {
  const MapInfo& info = after.info();
  DHPMAP_ASSIGN_OR_RETURN(
      Statement update,
      database.Prepare("UPDATE maps SET display_name = ?, revision = ?, num_frames = ?, next_submap_id = ?, "
                       "update_time_ns = ?, num_submaps = ?, checksum = ? WHERE map_key = ?",
                       kWriteTask));
  update.Bind(info.display_name).Bind(info.revision).Bind(info.num_frames).Bind(info.next_submap_id.value);
  const auto num_submaps = static_cast<std::int64_t>(after.submaps().size());
  update.Bind(info.update_time_ns).Bind(num_submaps).Bind(Checksum(info, num_submaps)).Bind(map_key);
  DHPMAP_RETURN_IF_ERROR(update.Run());
  if (ConfigToText(info.config) != ConfigToText(before.config)) {
    DHPMAP_RETURN_IF_ERROR(WriteConfig(database, map_key, info.config));
  }
  if (info.label_set != before.label_set && *info.label_set != *before.label_set) {
    DHPMAP_RETURN_IF_ERROR(WriteLabelSet(database, map_key, *info.label_set));
  }
  return Status::Ok();
}

Status DeleteMapRows(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadMapHead(database, name));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare("DELETE FROM maps WHERE map_key = ?", "delete the map"));
  return erase.Bind(head.key).Run();
}

}  // namespace dhpmap
