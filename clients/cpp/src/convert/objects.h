// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/map.h"
#include "dhpmap/object.h"
#include "dhpmap/v1/search.pb.h"
#include "dhpmap/v1/types.pb.h"

namespace dhpmap::client {

Object FromProto(const v1::Submap& submap);
/// Includes the distance of the match.
Object FromProto(const v1::SubmapMatch& match);

MapInfo FromProto(const v1::Map& map);
v1::LabelClass ToProto(const Label& label);

}  // namespace dhpmap::client
