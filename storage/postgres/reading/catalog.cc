// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/catalog.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "storage/postgres/reading/catalog_page.h"
#include "storage/postgres/rows/map_head.h"

namespace dhpmap::postgres {
namespace {

constexpr char kListTask[] = "list the maps";
const std::string kNames = "SELECT name FROM map_names WHERE name > $1 ORDER BY name LIMIT $2";

std::int64_t LimitOf(std::size_t max) {
  return static_cast<std::int64_t>(std::min<std::size_t>(max, std::numeric_limits<std::int64_t>::max()));
}

Result<StoredMap> Describe(MapHead& head, bool is_read, CatalogPage& page) {
  const std::string name = head.row.info.name;
  if (!is_read) return DamagedRows(name, "its row has a wrong checksum");
  const Status filled = FillInfo(head.row, page.parts[head.row.key]);
  if (filled.code() == StatusCode::kDataLoss) return DamagedRows(name, filled.message());
  DHPMAP_RETURN_IF_ERROR(filled);
  StoredMap map = std::move(page.rest[head.row.key]);
  map.info = std::move(head.row.info);
  map.num_submaps = head.row.num_submaps;
  map.blob_bytes += head.row.tiles.bytes;
  return map;
}

Result<CatalogPage> ReadOne(Connection& connection, const std::string& name) {
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(CatalogPage page, ReadCatalogPage(connection, std::move(call), TileSums::kAll));
  if (page.heads.empty()) return NoSuchMap(name);
  return page;
}

}  // namespace

Result<std::vector<StoredMap>> ListCatalog(Connection& connection, const std::string& after, std::size_t max) {
  Call call{&HeadsAfter()};
  call.values.Add(after).Add(LimitOf(max));
  DHPMAP_ASSIGN_OR_RETURN(CatalogPage page, ReadCatalogPage(connection, std::move(call), TileSums::kNone));
  std::vector<StoredMap> maps;
  maps.reserve(page.heads.size());
  for (auto& [head, is_read] : page.heads) {
    const std::string name = head.row.info.name;
    Result<StoredMap> map = Describe(head, is_read, page);
    maps.push_back(map.ok() ? std::move(map).value() : DamagedMap(name, map.status()));
  }
  return maps;
}

Result<std::vector<std::string>> ListNames(Connection& connection, const std::string& after, std::size_t max) {
  Call call{&kNames};
  call.values.Add(after).Add(LimitOf(max));
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kListTask));
  std::vector<std::string> names;
  while (answer.Next()) names.push_back(answer.Text());
  return names;
}

Result<StoredMap> FindInCatalog(Connection& connection, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(CatalogPage page, ReadOne(connection, name));
  return Describe(page.heads.front().first, page.heads.front().second, page);
}

}  // namespace dhpmap::postgres
