// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "dhpmap/v1/submap_service.pb.h"

namespace dhpmap::gateway {

/// A message of GetSubmapMesh; the first names the type and, if it is known, the size of the file.
inline std::string MeshPart(const std::string& data, const std::string& type = "", std::int64_t total = 0) {
  v1::GetSubmapMeshResponse part;
  part.set_data(data);
  part.set_content_type(type);
  part.set_total_bytes(total);
  return part.SerializeAsString();
}

}  // namespace dhpmap::gateway
