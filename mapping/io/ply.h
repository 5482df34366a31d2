// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// Binary little-endian PLY: vertices x y z nx ny nz red green blue class instance, and triangles.
std::string WritePly(const Mesh& mesh);

// The same file in pieces: its head, then all vertices, then all triangles.
std::string PlyHead(std::size_t num_vertices, std::size_t num_triangles);
std::size_t PlyBodyBytes(std::size_t num_vertices, std::size_t num_triangles);
void AppendPlyVertices(const Mesh& piece, std::string& file);
void AppendPlyTriangles(const Mesh& piece, std::string& file);

}  // namespace dhpmap
