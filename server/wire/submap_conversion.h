// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/submap_service.pb.h"
#include "mapping/map/map.h"
#include "server/app/edits/submap_edits.h"
#include "server/app/queries/submap_filter.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Converts one of the view's submaps. `reading`: whether the outline may read voxels from disk; it is left out
/// otherwise.
v1::Submap ToProto(const Submap& submap, const MapView& view,
                   OutlineCache::Reading reading = OutlineCache::Reading::kNever);

/// A submap of `map`; only the map's name, history and label set are used. `observed`: SphereOfObservedInMap.
v1::Submap ToProto(const SubmapInfo& info, const BoundingSphere& observed, std::int64_t num_blocks, const MapInfo& map);

/// INVALID_ARGUMENT, naming every bad field, for an unknown class name, an empty or non-finite region, a negative
/// radius.
Result<SubmapFilter> FilterFromProto(const v1::ListSubmapsRequest& request, const LabelSet& label_set);

/// The changes of a request: the fields of its mask, or all fields set without a mask. A pose may be partial
/// (map_from_submap.translation_m); the rest stays. INVALID_ARGUMENT naming every path of the mask that does not exist
/// or is read-only (`name` and `etag` are allowed: they identify the submap and its state), or every bad value.
Result<SubmapPatch> PatchFromProto(const v1::UpdateSubmapRequest& request);
/// The differences of a copy from its original.
Result<SubmapPatch> PatchFromProto(const v1::CloneSubmapRequest& request);

}  // namespace dhpmap
