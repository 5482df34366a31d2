// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/catalog.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "storage/postgres/commit/commit.h"
#include "storage/postgres/owners/lost_answer.h"
#include "storage/postgres/reading/map_reader.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kListTask[] = "list the maps";

const std::string kBeginReading = "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY";
const std::string kSums =
    "SELECT map_key, sum(num_tsdf_blocks)::bigint, sum(num_label_blocks)::bigint, sum(blob_bytes)::bigint FROM submaps "
    "WHERE map_key = ANY ($1) GROUP BY map_key";
const std::string kLost =
    "SELECT map_key, first_revision, last_revision FROM lost_revisions WHERE map_key = ANY ($1) ORDER BY map_key, "
    "first_revision";
const std::string kNames = "SELECT name FROM map_names WHERE name > $1 ORDER BY name LIMIT $2";

std::int64_t LimitOf(std::size_t max) {
  return static_cast<std::int64_t>(std::min<std::size_t>(max, std::numeric_limits<std::int64_t>::max()));
}

/// Whether the tiles of a map are summed up over its submaps.
enum class Sums { kNone, kAll };

/// What is read of the maps of a page.
struct Page {
  std::vector<std::pair<MapHead, bool>> heads;  ///< and whether the row could be read
  std::map<std::int64_t, MapParts> parts;
  std::map<std::int64_t, StoredMap> rest;  ///< what stands in no row of theirs
};

template <typename Row>
Call CallForAll(const Table<Row>& table, const char* order, const std::vector<std::int64_t>& keys) {
  static const std::string text = SelectText(table, std::string("WHERE map_key = ANY ($1) ORDER BY map_key, ") + order);
  Call call{&text};
  call.values.Add(std::span<const std::int64_t>(keys));
  return call;
}

template <typename Row>
void ReadAll(const Table<Row>& table, Answer& answer, std::vector<Row> MapParts::*list, Page& page) {
  while (answer.Next()) {
    Row row;
    (void)ReadRow(table, answer, row);  // a wrong value has another checksum
    (page.parts[row.map_key].*list).push_back(std::move(row));
  }
}

Status ReadRest(Connection& connection, const std::vector<std::int64_t>& keys, Sums sums, Page& page) {
  std::vector<Call> calls = {CallForAll(ConfigTable(), "key", keys),
                             CallForAll(Classes(), "class_id", keys),
                             CallForAll(Sessions(), "session", keys),
                             CallForAll(MergedTable(), "merged_id", keys),
                             CallForAll(PairTable(), "first_id, second_id", keys),
                             CallForAll(KeptClearTable(), "name", keys)};
  for (const std::string* text : {&kLost, &kSums}) {
    if (text == &kLost || sums == Sums::kAll) {
      calls.emplace_back(Call{text}).values.Add(std::span<const std::int64_t>(keys));
    }
  }
  if (keys.empty()) calls.clear();
  calls.push_back({&CommitText()});
  Answers got = connection.Run(calls, kListTask);
  if (!got.status.ok() || keys.empty()) return got.status;
  ReadAll(ConfigTable(), got.answers[0], &MapParts::config, page);
  ReadAll(Classes(), got.answers[1], &MapParts::classes, page);
  ReadAll(Sessions(), got.answers[2], &MapParts::sessions, page);
  ReadAll(MergedTable(), got.answers[3], &MapParts::merged, page);
  ReadAll(PairTable(), got.answers[4], &MapParts::pairs, page);
  ReadAll(KeptClearTable(), got.answers[5], &MapParts::kept_clear, page);
  for (Answer& lost = got.answers[6]; lost.Next();) {
    StoredMap& map = page.rest[lost.Int()];
    const std::int64_t first = lost.Int();
    map.lost_revisions.push_back({.first = first, .last = lost.Int()});
  }
  if (sums == Sums::kNone) return Status::Ok();
  for (Answer& sum = got.answers[7]; sum.Next();) {
    StoredMap& map = page.rest[sum.Int()];
    map.num_tsdf_blocks = sum.Int();
    map.num_label_blocks = sum.Int();
    map.blob_bytes = sum.Int();
  }
  return Status::Ok();
}

Result<StoredMap> Describe(MapHead& head, bool is_read, Page& page) {
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

/// One transaction of two round trips, so that no commit comes between.
Result<Page> ReadPage(Connection& connection, Call heads, Sums sums) {
  std::vector<Call> first = {{&kBeginReading}};
  first.push_back(std::move(heads));
  Answers got = connection.Run(first, kListTask);
  if (!got.status.ok()) return got.status;
  Page page;
  std::vector<std::int64_t> keys;
  for (Answer& answer = got.answers.back(); answer.Next();) {
    MapHead head;
    const bool is_read = ReadHead(answer, head);
    keys.push_back(head.row.key);
    page.heads.emplace_back(std::move(head), is_read);
  }
  DHPMAP_RETURN_IF_ERROR(ReadRest(connection, keys, sums, page));
  return page;
}

Result<Page> ReadOne(Connection& connection, const std::string& name) {
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(Page page, ReadPage(connection, std::move(call), Sums::kAll));
  if (page.heads.empty()) return NoSuchMap(name);
  return page;
}

}  // namespace

Result<std::vector<StoredMap>> ListCatalog(Connection& connection, const std::string& after, std::size_t max) {
  Call call{&HeadsAfter()};
  call.values.Add(after).Add(LimitOf(max));
  DHPMAP_ASSIGN_OR_RETURN(Page page, ReadPage(connection, std::move(call), Sums::kNone));
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
  DHPMAP_ASSIGN_OR_RETURN(Page page, ReadOne(connection, name));
  return Describe(page.heads.front().first, page.heads.front().second, page);
}

}  // namespace dhpmap::postgres
