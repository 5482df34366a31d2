// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// "thing", "stuff" or "unknown".
std::string KindName(v1::LabelClass::Kind kind);

/// The class of a map that a user means by its name (as the server takes it, see FindClassByName) or its id. NOT_FOUND
/// says which name is near, and lists the classes there are.
Result<v1::LabelClass> FindClass(const v1::Map& map, const std::string& name_or_id);

}  // namespace dhpmap
