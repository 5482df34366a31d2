// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dhpmap/v1/query_options.pb.h"
#include "mapping/base/result.h"
#include "mapping/map/map.h"

namespace dhpmap {

// Common parts of QueryOptions fields: names of submaps and classes, and names of fields in errors.

inline constexpr int kMostOptionItems = 1000;

Status BadOption(Reason reason, const std::string& field, const std::string& what);
/// The error for an option that the query does not support.
Status NotTaken(const std::string& field);

/// "list[number]".
std::string ItemOfOption(const std::string& list, int number);

/// INVALID_ARGUMENT for a list of more than kMostOptionItems.
Status CheckOptionLength(const std::string& list, int length);

/// NOT_FOUND for a missing submap, INVALID_ARGUMENT for a name that is not a submap of this map.
Result<SubmapId> OptionSubmapFromProto(const std::string& name, const std::string& field, const MapSnapshot& map);

/// INVALID_ARGUMENT, with similar names, for an unknown class.
Result<ClassId> OptionClassFromProto(const std::string& name, const std::string& field, const LabelSet& label_set);

}  // namespace dhpmap
