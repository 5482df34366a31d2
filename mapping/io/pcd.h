// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/result.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// Binary PCD of the vertices, written by PCL: x y z normal_x normal_y normal_z rgb class instance.
Result<std::string> WritePcd(const Mesh& mesh);

}  // namespace dhpmap
