// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/map_parts.h"

#include <algorithm>

#include "storage/rows/map_checksum_v1.h"

namespace dhpmap {
namespace {

/// Whether the row and its parts were written together.
Result<bool> IsIntact(const MapRow& row, const MapParts& parts) {
  const int version = row.seal.version;
  // Seals of older versions do not cover fields of later ones.
  const bool has_objects = !parts.merged.empty() || !parts.pairs.empty();
  if (version < 5 && (has_objects || row.merged_checksum != 0 || row.pairs_checksum != 0)) return false;
  if (version < 8 && row.leaving_id != -1) return false;
  if (version < 7 && (!parts.kept_clear.empty() || row.kept_clear_checksum != 0)) return false;
  if (version < 6 && row.tiles.sum != 0) return false;
  if (version < 4 && row.tiles.num_rows != 0) return false;
  if (version < 3 && (!parts.sessions.empty() || row.sessions_checksum != 0)) return false;
  if (version == 1) {
    DHPMAP_ASSIGN_OR_RETURN(const std::uint32_t checksum, MapChecksumV1(row, parts.config, parts.classes));
    return checksum == row.seal.checksum;
  }
  return version >= 2 && version <= MapSealVersion() && row.config_checksum == ConfigChecksum(parts.config) &&
         row.classes_checksum == ClassesChecksum(parts.classes, version) &&
         (version < 3 || row.sessions_checksum == SessionsChecksum(parts.sessions, version)) &&
         (version < 5 || (row.merged_checksum == MergedChecksum(parts.merged, version) &&
                          row.pairs_checksum == PairsChecksum(parts.pairs, version))) &&
         (version < 7 || row.kept_clear_checksum == KeptClearChecksum(parts.kept_clear, version)) &&
         row.seal.checksum == Maps().Checksum(row, version);
}

}  // namespace

Status NoSuchMap(const std::string& name) {
  return NotFound("there is no map '" + name + "'").WithReason("MAP_NOT_FOUND");
}

Status DamagedRows(const std::string& name, const std::string& what) {
  return DataLoss("map '" + name + "': " + what).WithReason("DAMAGED_MAP");
}

int MapSealVersion() {
  return std::max({Maps().version(), Classes().version(), Sessions().version(), MergedTable().version(),
                   PairTable().version(), KeptClearTable().version()});
}

MapParts MapPartsOf(std::int64_t map_key, const MapInfo& info) {
  MapParts parts;
  parts.config = ConfigRowsOf(map_key, info.config);
  for (const LabelClass& label : info.label_set->classes()) parts.classes.push_back({map_key, label});
  for (const SessionMark& mark : info.sessions.marks()) parts.sessions.push_back({map_key, mark});
  for (const MergedId& id : info.merged.list()) parts.merged.push_back({map_key, id});
  for (const ObjectPair& pair : info.pairs.pairs()) parts.pairs.push_back({map_key, pair});
  for (const KeptClearRegion& region : info.kept_clear.list()) parts.kept_clear.push_back({map_key, region});
  return parts;
}

void SealMapParts(MapRow& row, const MapParts& parts) {
  row.config_checksum = ConfigChecksum(parts.config);
  row.classes_checksum = ClassesChecksum(parts.classes, MapSealVersion());
  row.sessions_checksum = SessionsChecksum(parts.sessions, MapSealVersion());
  row.merged_checksum = MergedChecksum(parts.merged, MapSealVersion());
  row.pairs_checksum = PairsChecksum(parts.pairs, MapSealVersion());
  row.kept_clear_checksum = KeptClearChecksum(parts.kept_clear, MapSealVersion());
}

void SealMapRow(MapRow& row) { row.seal = {MapSealVersion(), Maps().Checksum(row, MapSealVersion())}; }

Status FillInfo(MapRow& row, const MapParts& parts) {
  DHPMAP_ASSIGN_OR_RETURN(const bool is_intact, IsIntact(row, parts));
  if (!is_intact) return DataLoss("its row has a wrong checksum");
  DHPMAP_ASSIGN_OR_RETURN(row.info.config, ConfigOf(parts.config));
  DHPMAP_ASSIGN_OR_RETURN(row.info.label_set, LabelSetOf(parts.classes));
  DHPMAP_ASSIGN_OR_RETURN(row.info.sessions, SessionMarksOf(parts.sessions));
  DHPMAP_ASSIGN_OR_RETURN(row.info.merged, MergedIdsOf(parts.merged));
  DHPMAP_ASSIGN_OR_RETURN(row.info.pairs, ObjectPairsOf(parts.pairs));
  DHPMAP_ASSIGN_OR_RETURN(row.info.kept_clear, KeptClearOf(parts.kept_clear));
  return Status::Ok();
}

bool HasReservedNumbers(const MapRow& row) {
  return row.marks.revision > row.info.revision || row.marks.next_submap_id > row.info.next_submap_id;
}

void RaiseMarks(MapRow& row) {
  row.marks.revision = std::max(row.marks.revision, row.info.revision);
  row.marks.next_submap_id = std::max(row.marks.next_submap_id, row.info.next_submap_id);
}

MapRow MapRowOf(const MapSnapshot& snapshot) {
  return {.info = snapshot.info(),
          .num_submaps = static_cast<std::int64_t>(snapshot.submaps().size()),
          .tiles = {},
          .seal = {}};
}

}  // namespace dhpmap
