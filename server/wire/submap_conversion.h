// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/submap_service.pb.h"
#include "mapping/map/map.h"
#include "server/app/edits/submap_edits.h"
#include "server/app/queries/submap_filter.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// One of the view's submaps. `reading`: whether voxels may be read from the disk for its outline, which is else left
/// out where they would have to be.
v1::Submap ToProto(const Submap& submap, const MapView& view,
                   OutlineCache::Reading reading = OutlineCache::Reading::kNever);

/// One of `map`'s, of which the name, history and label set count. `observed`: SphereOfObservedInMap.
v1::Submap ToProto(const SubmapInfo& info, const BoundingSphere& observed, std::int64_t num_blocks, const MapInfo& map);

/// INVALID_ARGUMENT, naming every bad field, for a class name that the label set lacks, an empty or non-finite region,
/// a negative radius.
Result<SubmapFilter> FilterFromProto(const v1::ListSubmapsRequest& request, const LabelSet& label_set);

/// What a request changes: the fields of its mask, or without a mask those that it sets. Part of a pose may be given
/// (map_from_submap.translation_m); the rest stays. INVALID_ARGUMENT naming every path of the mask that does not exist
/// or must not be changed (`name` and `etag` may be there: they say which submap and which state of it), or every bad
/// value.
Result<SubmapPatch> PatchFromProto(const v1::UpdateSubmapRequest& request);
/// What a copy has other than its original.
Result<SubmapPatch> PatchFromProto(const v1::CloneSubmapRequest& request);

}  // namespace dhpmap
