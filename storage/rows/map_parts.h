// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/map/map.h"
#include "storage/rows/class_rows.h"
#include "storage/rows/config_rows.h"
#include "storage/rows/kept_clear_rows.h"
#include "storage/rows/map_row.h"
#include "storage/rows/object_rows.h"
#include "storage/rows/session_rows.h"

namespace dhpmap {

// A map's row with what stands in other tables, as every store has them <-> MapInfo.

/// What stands in other tables. Each list in the order of its keys, which checksums depend on.
struct MapParts {
  std::vector<ConfigRow> config;
  std::vector<ClassRow> classes;
  std::vector<SessionRow> sessions;
  std::vector<MergedRow> merged;
  std::vector<PairRow> pairs;
  std::vector<KeptClearRow> kept_clear;
};

MapParts MapPartsOf(std::int64_t map_key, const MapInfo& info);

/// The version that map rows are sealed with now: it stands for the columns of their parts, too.
int MapSealVersion();
void SealMapParts(MapRow& row, const MapParts& parts);
/// With the checksums of its parts as they are in it.
void SealMapRow(MapRow& row);

/// Checks a row and its parts, and fills the row's info from them. DATA_LOSS if they are not what was written together;
/// FAILED_PRECONDITION as ConfigOf.
Status FillInfo(MapRow& row, const MapParts& parts);

/// Whether numbers beyond those of the row may be in use: see MapStore::Reserve.
bool HasReservedNumbers(const MapRow& row);
/// Raises the marks to the row's own numbers.
void RaiseMarks(MapRow& row);

/// Without a key, checksums and marks.
MapRow MapRowOf(const MapSnapshot& snapshot);

Status NoSuchMap(const std::string& name);
Status DamagedRows(const std::string& name, const std::string& what);

}  // namespace dhpmap
