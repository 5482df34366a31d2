// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// "thing", "stuff" or "unknown".
std::string KindName(v1::LabelClass::Kind kind);

/// Finds a class of the map by its name (as the server does, see FindClassByName) or id. The NOT_FOUND error suggests a
/// similar name and lists the classes.
Result<v1::LabelClass> FindClass(const v1::Map& map, const std::string& name_or_id);

}  // namespace dhpmap
