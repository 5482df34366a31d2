// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// Binary little-endian PLY: vertices x y z nx ny nz red green blue class instance, and triangles.
std::string WritePly(const Mesh& mesh);

}  // namespace dhpmap
