// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dhpmap/v1/query_options.pb.h"
#include "mapping/base/result.h"
#include "mapping/map/map.h"
#include "mapping/query/touch_lists.h"

namespace dhpmap {

/// The link names of the bodies or spheres of a request; may be empty.
struct RequestedLinks {
  const google::protobuf::RepeatedPtrField<std::string>& names;
  const char* field;      ///< "sphere_links"
  std::size_t num_parts;  ///< bodies or spheres
};

/// Allowed contacts.
struct AllowedTouches {
  TouchLists parts;                             ///< by body or sphere
  std::vector<std::vector<SubmapId>> attached;  ///< of each attached object
};

/// Limit of distinct lists of allowed contacts: each costs a pass over all submaps.
inline constexpr std::size_t kMostTouchLists = 64;

/// From options.allowed_collisions and the links of a request. `attached`: the attached objects; none without a robot.
/// INVALID_ARGUMENT for an unknown link, an object that is not attached, an unknown class, an entry without exactly one
/// target, or too many entries; NOT_FOUND for a missing submap. Errors name the field and the first bad item.
Result<AllowedTouches> AllowedTouchesFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                               const std::vector<SubmapId>& attached, const MapSnapshot& map);

}  // namespace dhpmap
