// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace dhpmap {

// A marching cubes cell has its 8 corners at voxel centres. Corner c is at offset (c & 1, c >> 1 & 1, c >> 2 & 1). Edge
// 4 * axis + k runs along `axis` from its corner of lower coordinate.

inline constexpr int kCellCorners = 8;
inline constexpr int kCellEdges = 12;

struct CellEdge {
  std::uint8_t corner = 0;  ///< the end of lower coordinate
  std::uint8_t axis = 0;
};
const std::array<CellEdge, kCellEdges>& CellEdgeTable();

/// What the surface does in a cell whose inside corners are the set bits of the table's index.
struct CellCase {
  std::uint16_t edges = 0;  ///< bit e: the surface crosses edge e
  std::uint8_t num_triangles = 0;
  /// Edges that hold the corners, counter-clockwise seen from outside.
  std::array<std::array<std::uint8_t, 3>, kCellEdges - 2> triangles{};
};
using CellCaseTable = std::array<CellCase, 1 << kCellCorners>;

/// Derived once, on first use, from one rule for the faces: inside corners that are diagonal on a face are not joined
/// across it. Two cells that share a face therefore always agree on it, and a surface has no holes.
const CellCaseTable& CellCases();

}  // namespace dhpmap
