// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/map_pages.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "storage/rows/map_parts.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kListTask[] = "list the maps";

/// Which maps a page has: two parameters, see BindPage.
constexpr char kOfPage[] = "WHERE map_key IN (SELECT map_key FROM maps WHERE name > ? ORDER BY name LIMIT ?)";

/// A page as it is read; parts by map_key.
struct Page {
  std::string after;
  std::int64_t max = 0;
  std::vector<std::pair<MapRow, bool>> rows;  ///< and whether the row's columns could be read
  std::map<std::int64_t, MapParts> parts;
  std::map<std::int64_t, LostRevisions> lost;
};

std::int64_t LimitOf(std::size_t max) {
  return static_cast<std::int64_t>(std::min<std::size_t>(max, std::numeric_limits<std::int64_t>::max()));
}

Statement& BindPage(Statement& select, const Page& page) { return select.Bind(page.after).Bind(page.max); }

Status ReadRows(Database& database, Page& page) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(Maps().Select("WHERE name > ? ORDER BY name LIMIT ?"), kListTask));
  BindPage(select, page);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    MapRow row;
    const bool is_read = Maps().Read(select, row);
    page.rows.emplace_back(std::move(row), is_read);
  }
}

/// A value of a wrong type is left out of its row, whose checksum then is another.
template <typename Row>
Status ReadPart(Database& database, const Table<Row>& table, const char* order, std::vector<Row> MapParts::*list,
                Page& page) {
  const std::string tail = std::string(kOfPage) + " ORDER BY map_key, " + order;
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(table.Select(tail), kListTask));
  BindPage(select, page);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    Row row;
    (void)table.Read(select, row);
    (page.parts[row.map_key].*list).push_back(std::move(row));
  }
}

Status ReadLost(Database& database, Page& page) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare("SELECT map_key, first_revision, last_revision FROM lost_revisions " +
                                               std::string(kOfPage) + " ORDER BY map_key, first_revision",
                                           kListTask));
  BindPage(select, page);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    sqlite::Columns columns(select);
    LostRevisions& lost = page.lost[columns.Int()];
    const std::int64_t first = columns.Int();
    lost.push_back({.first = first, .last = columns.Int()});
  }
}

Result<StoredMap> MapOf(MapRow& row, bool is_read, Page& page) {
  if (!is_read) return DamagedRows(row.info.name, "its row has a wrong checksum");
  const Status filled = FillInfo(row, page.parts[row.key]);
  if (filled.code() == StatusCode::kDataLoss) return DamagedRows(row.info.name, filled.message());
  DHPMAP_RETURN_IF_ERROR(filled);
  StoredMap map{.info = std::move(row.info), .num_submaps = row.num_submaps, .damage = {}};
  map.lost_revisions = std::move(page.lost[row.key]);
  return map;
}

}  // namespace

Result<std::vector<StoredMap>> ReadMapPage(Database& database, const std::string& after, std::size_t max) {
  Page page{.after = after, .max = LimitOf(max)};
  DHPMAP_RETURN_IF_ERROR(ReadRows(database, page));
  DHPMAP_RETURN_IF_ERROR(ReadPart(database, ConfigTable(), "key", &MapParts::config, page));
  DHPMAP_RETURN_IF_ERROR(ReadPart(database, Classes(), "class_id", &MapParts::classes, page));
  DHPMAP_RETURN_IF_ERROR(ReadPart(database, Sessions(), "session", &MapParts::sessions, page));
  DHPMAP_RETURN_IF_ERROR(ReadPart(database, MergedTable(), "merged_id", &MapParts::merged, page));
  DHPMAP_RETURN_IF_ERROR(ReadPart(database, PairTable(), "first_id, second_id", &MapParts::pairs, page));
  DHPMAP_RETURN_IF_ERROR(ReadPart(database, KeptClearTable(), "name", &MapParts::kept_clear, page));
  DHPMAP_RETURN_IF_ERROR(ReadLost(database, page));
  std::vector<StoredMap> maps;
  maps.reserve(page.rows.size());
  for (auto& [row, is_read] : page.rows) {
    const std::string name = row.info.name;
    Result<StoredMap> map = MapOf(row, is_read, page);
    maps.push_back(map.ok() ? std::move(map).value() : DamagedMap(name, map.status()));
  }
  return maps;
}

Result<std::vector<std::string>> ReadMapNamesAfter(Database& database, const std::string& after, std::size_t max) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare("SELECT name FROM maps WHERE name > ? ORDER BY name LIMIT ?", kListTask));
  select.Bind(after).Bind(LimitOf(max));
  std::vector<std::string> names;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return names;
    names.push_back(select.Text(0));
  }
}

}  // namespace dhpmap
