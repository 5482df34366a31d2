// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/map_reader.h"

#include <span>
#include <string>
#include <vector>

#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/reading/state_maker.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/rows/part_rows.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/rows/submap_rows.h"
#include "storage/submap_maker.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadStateTask[] = "read the map";

Result<std::vector<SubmapRow>> SubmapsOf(Answer& answer, const MapRow& map) {
  std::vector<SubmapRow> rows;
  while (answer.Next()) {
    SubmapRow& row = rows.emplace_back();
    if (ReadRow(Submaps(), answer, row) && Submaps().IsIntact(row, row.seal)) continue;
    return DataLoss("submap " + std::to_string(row.info.id.value) + ": its row has a wrong checksum");
  }
  if (static_cast<std::int64_t>(rows.size()) == map.num_submaps) return rows;
  return DataLoss("has " + std::to_string(rows.size()) + " submaps, not " + std::to_string(map.num_submaps));
}

}  // namespace

Result<std::shared_ptr<const MapSnapshot>> ReadMapState(Connection& connection, const std::string& name,
                                                        std::int64_t map_key, std::uint16_t store, ThreadPool& pool,
                                                        const std::shared_ptr<PageReader>& pages) {
  static const std::string submaps = SelectText(Submaps(), "WHERE map_key = $1 ORDER BY submap_id");
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  std::vector<Call> calls = CallsForParts(map_key);
  calls.emplace_back(Call{&HeadByKey()}).values.Add(map_key);
  calls.emplace_back(Call{&submaps}).values.Add(map_key);
  Answers got = connection.Run(calls, kReadStateTask);
  if (!got.status.ok()) return got.status;
  MapHead head;
  if (!got.answers[6].Next()) return NoSuchMap(name);
  if (!ReadHead(got.answers[6], head)) return DamagedRows(name, "its row has a wrong checksum");
  const auto parts = ReadParts(std::span(got.answers).first(6));
  const Status filled = parts.ok() ? FillInfo(head.row, *parts) : parts.status();
  if (filled.code() == StatusCode::kDataLoss) return DamagedRows(name, filled.message());
  DHPMAP_RETURN_IF_ERROR(filled);
  const auto make = [&]() -> Result<std::shared_ptr<const MapSnapshot>> {
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> rows, SubmapsOf(got.answers[7], head.row));
    return pages == nullptr ? MakeState(connection, head.row, rows, store, pool)
                            : MakePagedState(connection, head.row, rows, store, pool, pages);
  };
  auto state = make();
  const StatusCode code = state.status().code();
  const bool is_damage = code == StatusCode::kDataLoss || code == StatusCode::kFailedPrecondition;
  return is_damage ? DamagedState(name, state.status()) : state;
}

}  // namespace dhpmap::postgres
