// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/cpp/src/convert/geometry.h"
#include "dhpmap/edit.h"
#include "dhpmap/v1/edit_service.pb.h"

namespace dhpmap::client {

/// The ids at the ends of names.
inline std::vector<std::int64_t> IdsOf(const google::protobuf::RepeatedPtrField<std::string>& names) {
  std::vector<std::int64_t> ids;
  for (const std::string& name : names) ids.push_back(IdOfName(name));
  return ids;
}

inline EditResult FromProto(const v1::EditResult& result) {
  return {IdsOf(result.changed_submaps()), IdsOf(result.created_submaps()), IdsOf(result.removed_submaps()),
          result.num_voxels()};
}

/// For UndoEditsResponse and RedoEditsResponse.
template <typename Response>
Undone UndoneOf(const Response& response) {
  return {response.revision(), IdsOf(response.edits()), IdsOf(response.changed_submaps()),
          IdsOf(response.created_submaps()), IdsOf(response.removed_submaps())};
}

}  // namespace dhpmap::client
