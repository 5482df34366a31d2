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

/// The links that the bodies or spheres of a request belong to: a name each, or none.
struct RequestedLinks {
  const google::protobuf::RepeatedPtrField<std::string>& names;
  const char* field;      ///< "sphere_links"
  std::size_t num_parts;  ///< bodies or spheres
};

/// What may touch what.
struct AllowedTouches {
  TouchLists parts;                             ///< by body or sphere
  std::vector<std::vector<SubmapId>> attached;  ///< of each object that is attached
};

/// So many different lists of what may be touched: each costs a look at all submaps.
inline constexpr std::size_t kMostTouchLists = 64;

/// Of options.allowed_collisions and the links of a request. `attached`: objects that the robot carries, none where
/// there is no robot. INVALID_ARGUMENT for a link that no part has, an object that is not attached, a class that there
/// is not, other than one of what may be touched, or too much of all that; NOT_FOUND for a submap that is not there.
/// Each names the field and the first item that is wrong.
Result<AllowedTouches> AllowedTouchesFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                               const std::vector<SubmapId>& attached, const MapSnapshot& map);

}  // namespace dhpmap
