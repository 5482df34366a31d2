// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/submap_writes.h"

#include <string>

#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

const std::string kEraseSubmap = "DELETE FROM submaps WHERE map_key = $1 AND submap_id = $2";

}  // namespace

void SubmapWrites::Fetched(Answer& submaps) {
  while (submaps.Next()) {
    SubmapRow row;
    (void)ReadRow(Submaps(), submaps, row);  // a damaged row is replaced: the state in memory is whole
    stored_[row.info.id.value] = row;
  }
}

Result<std::optional<SubmapTable::Stored>> SubmapWrites::Find(std::int64_t, SubmapId id) {
  const auto found = stored_.find(id.value);
  if (found == stored_.end()) return std::optional<Stored>();
  const SubmapRow& row = found->second;
  return std::optional(Stored{std::int64_t{id.value}, row.counts, row.tiles_sum, row.CoversTiles()});
}

Result<std::int64_t> SubmapWrites::Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                                         std::int64_t tiles_sum) {
  const std::int64_t key = submap.id().value;
  written_[key] = SubmapRowOf(map_key, submap, counts, tiles_sum);
  return key;
}

Status SubmapWrites::Erase(std::int64_t submap_key) {
  erased_.push_back(submap_key);
  tiles_.EraseAll(submap_key);
  return Status::Ok();
}

void SubmapWrites::Write(std::int64_t map_key, std::vector<Call>& calls) const {
  static const std::string upsert = UpsertText(Submaps());
  for (const std::int64_t id : erased_) calls.emplace_back(Call{&kEraseSubmap}).values.Add(map_key).Add(id);
  for (const auto& entry : written_) Submaps().BindAll(entry.second, calls.emplace_back(Call{&upsert}).values);
}

void SubmapWrites::AddTo(CommitPlaces& places) const {
  for (const std::int64_t id : erased_) places.AddRow(id);
  for (const auto& entry : written_) places.AddRow(entry.first);
}

}  // namespace dhpmap::postgres
