// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include "dhpmap/v1/types.pb.h"
#include "mapping/map/map_config.h"
#include "server/app/map_registry.h"

namespace dhpmap {

/// Overwrites the fields of `config` that are set in `proto`. The fields are found through VisitFields by their keys,
/// so there is no second list of them. INVALID_ARGUMENT, with violations below "config.", for an unknown enum value.
Status MergeConfig(const v1::MapConfig& proto, MapConfig& config);

/// With every field set.
v1::MapConfig ToProto(const MapConfig& config);

/// INVALID_ARGUMENT naming every bad class.
Result<LabelSet> LabelSetFromProto(const google::protobuf::RepeatedPtrField<v1::LabelClass>& classes);

v1::PanopticKind ToProto(Panoptic panoptic);
v1::Color ToProto(Color color);
v1::Map ToProto(const MapSummary& map);

}  // namespace dhpmap
