// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dhpmap/v1/edit_service.pb.h"
#include "server/app/edits/edit_list.h"

namespace dhpmap {

/// INVALID_ARGUMENT naming every bad field ("edits[2].split.plane.normal") for names of another map or none, classes
/// that the label set lacks, poses, regions and planes that are not usable, and edits that say nothing.
Result<EditList> EditListFromProto(const v1::ApplyEditsRequest& request, const std::string& map,
                                   const LabelSet& label_set);

v1::IgnoredRegion ToProto(const KeptClearRegion& region);

v1::EditResult ToProto(const EditResult& result, const std::string& map);

}  // namespace dhpmap
