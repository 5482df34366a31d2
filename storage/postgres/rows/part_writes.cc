// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/rows/part_writes.h"

#include <string>

#include "storage/postgres/rows/row_diff.h"

namespace dhpmap::postgres {
namespace {

const std::string kDeleteConfig = "DELETE FROM map_config WHERE map_key = $1";

/// Replaces all stored keys, retired ones included.
void WriteConfig(const std::vector<ConfigRow>& rows, std::vector<Call>& calls) {
  static const std::string insert = InsertText(ConfigTable());
  calls.emplace_back(Call{&kDeleteConfig}).values.Add(rows.front().map_key);
  for (const ConfigRow& row : rows) ConfigTable().BindAll(row, calls.emplace_back(Call{&insert}).values);
}

}  // namespace

bool IsSameConfig(const MapParts& a, const MapParts& b) { return ConfigChecksum(a.config) == ConfigChecksum(b.config); }

void WriteParts(const MapParts& before, const MapParts& after, std::vector<Call>& calls) {
  if (!IsSameConfig(before, after)) WriteConfig(after.config, calls);
  WritePartsBesideConfig(before, after, calls);
}

void WritePartsBesideConfig(const MapParts& before, const MapParts& after, std::vector<Call>& calls) {
  WriteDiff(Classes(), before.classes, after.classes, calls);
  WriteDiff(Sessions(), before.sessions, after.sessions, calls);
  WriteDiff(MergedTable(), before.merged, after.merged, calls);
  WriteDiff(PairTable(), before.pairs, after.pairs, calls);
  WriteDiff(KeptClearTable(), before.kept_clear, after.kept_clear, calls);
}

}  // namespace dhpmap::postgres
