// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dhpmap/v1/edit_service.pb.h"
#include "server/app/edits/edit_list.h"

namespace dhpmap {

/// INVALID_ARGUMENT naming every bad field ("edits[2].split.plane.normal") for names that are malformed or of another
/// map, unknown classes, invalid poses, regions and planes, and empty edits.
Result<EditList> EditListFromProto(const v1::ApplyEditsRequest& request, const std::string& map,
                                   const LabelSet& label_set);

v1::IgnoredRegion ToProto(const KeptClearRegion& region);

v1::EditResult ToProto(const EditResult& result, const std::string& map);

}  // namespace dhpmap
