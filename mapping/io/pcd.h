// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "mapping/base/result.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// Binary PCD of the vertices, written by PCL: x y z normal_x normal_y normal_z rgb class instance.
Result<std::string> WritePcd(const Mesh& mesh);

// The same file in pieces: its head, then all vertices.
Result<std::string> PcdHead(std::size_t num_vertices);
std::size_t PcdBodyBytes(std::size_t num_vertices);
void AppendPcdPoints(const Mesh& piece, std::string& file);

}  // namespace dhpmap
