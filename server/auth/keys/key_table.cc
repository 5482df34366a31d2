// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_table.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace dhpmap::auth {
namespace {

Result<std::vector<KeyRecord>> RecordsOfRows(const KeyRows& keys) {
  std::vector<KeyRecord> records;
  records.reserve(keys.rows.size());
  for (const KeyRow& row : keys.rows) {
    auto record = RecordFromLine(row.record);
    const std::string where = "the key " + row.id.substr(0, kKeyIdDigits) + " in the database is not usable: ";
    if (!record.ok()) return FailedPrecondition(where + record.status().message()).WithReason("BAD_KEY_FILE");
    if (record->id != row.id) return FailedPrecondition(where + "its ids differ").WithReason("BAD_KEY_FILE");
    records.push_back(*std::move(record));
  }
  // The book takes the last key of a name for the newest, as in a file.
  std::stable_sort(records.begin(), records.end(),
                   [](const KeyRecord& a, const KeyRecord& b) { return a.created_s < b.created_s; });
  return records;
}

std::vector<KeyRow> ChangedRows(const KeyRows& before, const std::vector<KeyRecord>& after) {
  std::map<std::string, std::string> known;
  for (const KeyRow& row : before.rows) known.emplace(row.id, row.record);
  std::vector<KeyRow> changed;
  for (const KeyRecord& record : after) {
    std::string line = LineOf(record);
    const auto found = known.find(record.id);
    if (found == known.end() || found->second != line) changed.push_back({record.id, std::move(line)});
  }
  return changed;
}

}  // namespace

Result<KeyTableContent> ReadKeyTable(AuthTables& tables) {
  DHPMAP_ASSIGN_OR_RETURN(const KeyRows keys, tables.ReadKeys());
  DHPMAP_ASSIGN_OR_RETURN(auto records, RecordsOfRows(keys));
  return KeyTableContent{std::move(records), keys.version};
}

Status ChangeKeyTable(AuthTables& tables, const std::function<Status(std::vector<KeyRecord>&)>& change) {
  constexpr int kMostTries = 10;
  Status written;
  for (int tries = 0; tries < kMostTries; ++tries) {
    DHPMAP_ASSIGN_OR_RETURN(const KeyRows before, tables.ReadKeys());
    DHPMAP_ASSIGN_OR_RETURN(auto records, RecordsOfRows(before));
    DHPMAP_RETURN_IF_ERROR(change(records));
    const std::vector<KeyRow> changed = ChangedRows(before, records);
    if (changed.empty()) return Status::Ok();
    written = tables.WriteKeys(before.version, changed);
    if (written.code() != StatusCode::kAborted) return written;
  }
  return written;
}

}  // namespace dhpmap::auth
