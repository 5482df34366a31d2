// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/catalog_page.h"

#include <span>
#include <string>

#include "storage/postgres/rows/table_text.h"
#include "storage/postgres/transaction_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadPageTask[] = "list the maps";
const std::string kBeginReading = "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY";
const std::string kSums =
    "SELECT map_key, sum(num_tsdf_blocks)::bigint, sum(num_label_blocks)::bigint, sum(blob_bytes)::bigint FROM submaps "
    "WHERE map_key = ANY ($1) GROUP BY map_key";
const std::string kLost =
    "SELECT map_key, first_revision, last_revision FROM lost_revisions WHERE map_key = ANY ($1) ORDER BY map_key, "
    "first_revision";

template <typename Row>
Call CallForAll(const Table<Row>& table, const char* order, const std::vector<std::int64_t>& keys) {
  static const std::string text = SelectText(table, std::string("WHERE map_key = ANY ($1) ORDER BY map_key, ") + order);
  Call call{&text};
  call.values.Add(std::span<const std::int64_t>(keys));
  return call;
}

template <typename Row>
void ReadAll(const Table<Row>& table, Answer& answer, std::vector<Row> MapParts::*list, CatalogPage& page) {
  while (answer.Next()) {
    Row row;
    (void)ReadRow(table, answer, row);  // a wrong value fails the checksum
    (page.parts[row.map_key].*list).push_back(std::move(row));
  }
}

Status ReadRest(Connection& connection, const std::vector<std::int64_t>& keys, TileSums sums, CatalogPage& page) {
  std::vector<Call> calls = {CallForAll(ConfigTable(), "key", keys),
                             CallForAll(Classes(), "class_id", keys),
                             CallForAll(Sessions(), "session", keys),
                             CallForAll(MergedTable(), "merged_id", keys),
                             CallForAll(PairTable(), "first_id, second_id", keys),
                             CallForAll(KeptClearTable(), "name", keys)};
  for (const std::string* text : {&kLost, &kSums}) {
    if (text == &kLost || sums == TileSums::kAll) {
      calls.emplace_back(Call{text}).values.Add(std::span<const std::int64_t>(keys));
    }
  }
  if (keys.empty()) calls.clear();
  calls.push_back({&CommitText()});
  Answers got = connection.Run(calls, kReadPageTask);
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
  if (sums == TileSums::kNone) return Status::Ok();
  for (Answer& sum = got.answers[7]; sum.Next();) {
    StoredMap& map = page.rest[sum.Int()];
    map.num_tsdf_blocks = sum.Int();
    map.num_label_blocks = sum.Int();
    map.blob_bytes = sum.Int();
  }
  return Status::Ok();
}

}  // namespace

Result<CatalogPage> ReadCatalogPage(Connection& connection, Call heads, TileSums sums) {
  std::vector<Call> first = {{&kBeginReading}};
  first.push_back(std::move(heads));
  Answers got = connection.Run(first, kReadPageTask);
  if (!got.status.ok()) return got.status;
  CatalogPage page;
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

}  // namespace dhpmap::postgres
