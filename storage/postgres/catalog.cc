// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/catalog.h"

#include <map>
#include <span>
#include <utility>

#include "storage/postgres/commit.h"
#include "storage/postgres/lost_answer.h"
#include "storage/postgres/map_reader.h"
#include "storage/postgres/table_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kListTask[] = "list the maps";
constexpr std::int64_t kMapsAPage = 256;

const std::string kSums =
    "SELECT map_key, sum(num_tsdf_blocks)::bigint, sum(num_label_blocks)::bigint, sum(blob_bytes)::bigint FROM submaps "
    "WHERE map_key = ANY ($1) GROUP BY map_key";
const std::string kLost =
    "SELECT map_key, first_revision, last_revision FROM lost_revisions WHERE map_key = ANY ($1) ORDER BY map_key, "
    "first_revision";
const std::string kNoteLost = "INSERT INTO lost_revisions (map_key, first_revision, last_revision) VALUES ($1, $2, $3)";

/// What is read of the maps of a page.
struct Page {
  std::vector<std::pair<MapHead, bool>> heads;  ///< and whether the row could be read
  std::map<std::int64_t, MapParts> parts;
  std::map<std::int64_t, StoredMap> sums;
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

Status ReadRest(Connection& connection, const std::vector<std::int64_t>& keys, Page& page) {
  std::vector<Call> calls = {CallForAll(ConfigTable(), "key", keys),
                             CallForAll(Classes(), "class_id", keys),
                             CallForAll(Sessions(), "session", keys),
                             CallForAll(MergedTable(), "merged_id", keys),
                             CallForAll(PairTable(), "first_id, second_id", keys),
                             CallForAll(KeptClearTable(), "name", keys)};
  for (const std::string* text : {&kSums, &kLost}) {
    calls.emplace_back(Call{text}).values.Add(std::span<const std::int64_t>(keys));
  }
  Answers got = connection.Run(calls, kListTask);
  if (!got.status.ok()) return got.status;
  ReadAll(ConfigTable(), got.answers[0], &MapParts::config, page);
  ReadAll(Classes(), got.answers[1], &MapParts::classes, page);
  ReadAll(Sessions(), got.answers[2], &MapParts::sessions, page);
  ReadAll(MergedTable(), got.answers[3], &MapParts::merged, page);
  ReadAll(PairTable(), got.answers[4], &MapParts::pairs, page);
  ReadAll(KeptClearTable(), got.answers[5], &MapParts::kept_clear, page);
  for (Answer& sums = got.answers[6]; sums.Next();) {
    StoredMap& map = page.sums[sums.Int()];
    map.num_tsdf_blocks = sums.Int();
    map.num_label_blocks = sums.Int();
    map.blob_bytes = sums.Int();
  }
  for (Answer& lost = got.answers[7]; lost.Next();) {
    StoredMap& map = page.sums[lost.Int()];
    const std::int64_t first = lost.Int();
    map.lost_revisions.push_back({.first = first, .last = lost.Int()});
  }
  return Status::Ok();
}

Result<StoredMap> Describe(MapHead& head, bool is_read, Page& page) {
  const std::string name = head.row.info.name;
  if (!is_read) return DamagedRows(name, "its row has a wrong checksum");
  const Status filled = FillInfo(head.row, page.parts[head.row.key]);
  if (filled.code() == StatusCode::kDataLoss) return DamagedRows(name, filled.message());
  DHPMAP_RETURN_IF_ERROR(filled);
  StoredMap map = std::move(page.sums[head.row.key]);
  map.info = std::move(head.row.info);
  map.num_submaps = head.row.num_submaps;
  map.blob_bytes += head.row.tiles.bytes;
  return map;
}

/// One transaction for both trips, so that no commit comes between.
Result<Page> ReadPage(Connection& connection, const Call& heads) {
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  Page page;
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(heads, kListTask));
  std::vector<std::int64_t> keys;
  while (answer.Next()) {
    MapHead head;
    const bool is_read = ReadHead(answer, head);
    keys.push_back(head.row.key);
    page.heads.emplace_back(std::move(head), is_read);
  }
  if (!keys.empty()) DHPMAP_RETURN_IF_ERROR(ReadRest(connection, keys, page));
  return page;
}

Result<Page> ReadOne(Connection& connection, const std::string& name) {
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(Page page, ReadPage(connection, call));
  if (page.heads.empty()) return NoSuchMap(name);
  return page;
}

/// The head that a new owner writes in place of what was read.
MapHead HeadOfNewOwner(const MapHead& read, std::int64_t server) {
  MapHead head = read;
  ++head.commit_id;
  ++head.owner_epoch;
  head.owner = server;
  MapRow& row = head.row;
  if (row.marks.revision > row.info.revision || row.marks.next_submap_id > row.info.next_submap_id) {
    RaiseMarks(row);
    row.info.revision = row.marks.revision + 1;
    row.info.next_submap_id = row.marks.next_submap_id;
    RaiseMarks(row);
    SealMapRow(row);
  }
  return head;
}

}  // namespace

Result<std::vector<StoredMap>> ListCatalog(Connection& connection) {
  std::vector<StoredMap> maps;
  for (std::string from;;) {
    Call call{&HeadsFrom()};
    call.values.Add(from).Add(kMapsAPage);
    DHPMAP_ASSIGN_OR_RETURN(Page page, ReadPage(connection, call));
    for (auto& [head, is_read] : page.heads) {
      from = head.row.info.name + '\x01';  // the next name: none has such a character
      Result<StoredMap> map = Describe(head, is_read, page);
      if (!map.ok()) {
        StoredMap damaged;
        damaged.info.name = head.row.info.name;
        damaged.damage = map.status();
        maps.push_back(std::move(damaged));
      } else {
        maps.push_back(std::move(map).value());
      }
    }
    if (static_cast<std::int64_t>(page.heads.size()) < kMapsAPage) return maps;
  }
}

Result<StoredMap> FindInCatalog(Connection& connection, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(Page page, ReadOne(connection, name));
  return Describe(page.heads.front().first, page.heads.front().second, page);
}

Result<std::shared_ptr<OwnedMap>> TakeMap(Connection& connection, const std::string& name, std::int64_t server,
                                          const PassingTime& passing) {
  DHPMAP_ASSIGN_OR_RETURN(Page page, ReadOne(connection, name));
  auto& [read, is_read] = page.heads.front();
  const MapHead before = read;
  DHPMAP_RETURN_IF_ERROR(Describe(read, is_read, page).status());
  MapHead after = HeadOfNewOwner(before, server);
  std::vector<Call> calls = {{&BeginText()}, ReplaceHead(before, after)};
  if (after.row.info.revision > before.row.info.revision + 1) {
    Values& lost = calls.emplace_back(Call{&kNoteLost}).values;
    lost.Add(before.row.key).Add(before.row.info.revision + 1).Add(after.row.info.revision - 1);
  }
  calls.push_back({&CommitText()});
  const Answers done = connection.Run(calls, "take the map");
  if (IsFenced(done.sqlstate)) return NotOwner(name);
  if (!done.status.ok()) return done.status;
  return std::make_shared<OwnedMap>(name, before.row.key, after.owner_epoch, before.seen_ns, passing);
}

}  // namespace dhpmap::postgres
