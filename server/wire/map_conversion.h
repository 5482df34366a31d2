// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/map_service.pb.h"
#include "mapping/map/map_config.h"
#include "server/app/edits/map_edits.h"
#include "server/app/maps/map_registry.h"
#include "server/app/maps/map_stats.h"

namespace dhpmap {

/// Overwrites the fields of `config` that are set in `proto`, found by the keys of VisitFields, so there is no second
/// list of them. INVALID_ARGUMENT, with violations below "config.", for an unknown enum value.
Status MergeConfig(const v1::MapConfig& proto, MapConfig& config);

/// With every field set.
v1::MapConfig ToProto(const MapConfig& config);

/// A new map from a request; `default_config` applies without a preset. INVALID_ARGUMENT naming all bad fields at once.
Result<MapInfo> InfoFromProto(const v1::CreateMapRequest& request, const MapConfig& default_config);

/// From the first message of an import.
ImportRequest ImportRequestFromProto(const v1::ImportMapRequest& request);

v1::Map ToProto(const MapSummary& map);
v1::MapRevision RevisionToProto(const MapInfo& map);
/// INVALID_ARGUMENT if the mask names fields other than display_name, name and etag.
Result<MapPatch> PatchFromProto(const v1::UpdateMapRequest& request);
v1::GetMapStatsResponse ToProto(const MapReport& report);
v1::VerifyMapResponse ToProto(const VerifyReport& report);

}  // namespace dhpmap
