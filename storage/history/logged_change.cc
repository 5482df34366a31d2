// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/logged_change.h"

#include <utility>

#include "storage/codec/change_codec.h"

namespace dhpmap {

bool IsBeyond(const ChangeHistoryLimits& limits, const ChangeTotals& totals, std::int64_t oldest_ns,
              std::int64_t now_ns) {
  return totals.num_changes > limits.max_changes || totals.num_bytes > limits.max_bytes ||
         static_cast<double>(now_ns - oldest_ns) > limits.max_age_s * 1e9;
}

Status ChangesNotKept(std::int64_t complete_after) {
  return OutOfRange("changes are kept from revision " + std::to_string(complete_after + 1) +
                    " on: list the map again and go on from there")
      .WithReason("COMPACTED")
      .WithMetadata("oldest_revision", std::to_string(complete_after + 1));
}

Status DamagedChanges(const std::string& map, std::int64_t after_revision) {
  return DataLoss("map '" + map + "': what is kept of its changes after revision " + std::to_string(after_revision) +
                  " is damaged")
      .WithReason("DAMAGED_CHANGES");
}

ChangeRow ChangeRowOf(const MapChange& change, Bytes blob, std::int64_t now_ns, const ChangeLogRow& log) {
  ChangeRow row{.map_key = log.map_key,
                .last_revision = change.last_revision,
                .first_revision = change.first_revision,
                .previous_revision = log.last_revision,
                .time_ns = change.time_ns,
                .blob = {std::move(blob)},
                .seen_ns = now_ns,
                .seal = {}};
  row.seal = Changes().SealOf(row);
  return row;
}

Result<std::shared_ptr<const MapChange>> ChangeOf(bool is_read, const ChangeRow& row, const std::string& map,
                                                  const ChangePlace& place) {
  const bool is_intact = is_read && Changes().IsIntact(row, row.seal);
  const bool follows =
      place.is_first ? row.previous_revision <= place.previous : row.previous_revision == place.previous;
  if (!is_intact || !follows) return DamagedChanges(map, place.previous);
  auto change = std::make_shared<MapChange>();
  change->first_revision = row.first_revision;
  change->last_revision = row.last_revision;
  change->time_ns = row.time_ns;
  const Status decoded = DecodeChange(row.blob.bytes, *change);
  if (decoded.code() == StatusCode::kDataLoss) return DamagedChanges(map, place.previous);
  if (!decoded.ok()) return decoded;
  return std::shared_ptr<const MapChange>(std::move(change));
}

}  // namespace dhpmap
