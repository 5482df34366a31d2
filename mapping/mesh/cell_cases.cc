// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/cell_cases.h"

#include <bit>
#include <limits>
#include <span>
#include <vector>

namespace dhpmap {
namespace {

using Triangles = std::vector<std::array<std::uint8_t, 3>>;

std::uint8_t EdgeBetween(int corner_a, int corner_b) {
  const int axis = std::countr_zero(static_cast<unsigned>(corner_a ^ corner_b));
  const int low = corner_a & corner_b;
  // k numbers the four edges parallel to an axis by the other two coordinates of the corner.
  const int k = (low >> ((axis + 1) % 3) & 1) | (low >> ((axis + 2) % 3) & 1) << 1;
  return static_cast<std::uint8_t>(4 * axis + k);
}

/// The corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> FaceCorners(int axis, int side) {
  const int b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3, base = side << axis;
  if (side == 1) return {base, base | b, base | b | c, base | c};
  return {base, base | c, base | b | c, base | b};
}

/// Bit 2 * axis + side for each of the two faces that contain an edge.
unsigned FacesOfEdge(int edge) {
  const CellEdge& e = CellEdgeTable()[static_cast<std::size_t>(edge)];
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != e.axis) faces |= 1u << (2 * axis + (e.corner >> axis & 1));
  }
  return faces;
}

/// For each edge that the surface crosses, the next edge of the surface's outline. On a face the outline goes from
/// where the walk along its corners enters the inside to where it leaves, so the outside is on its right.
std::array<int, kCellEdges> LinkEdges(unsigned inside) {
  std::array<int, kCellEdges> next;
  next.fill(-1);
  const auto is_inside = [inside](int corner) { return (inside >> corner & 1) != 0; };
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corners = FaceCorners(face / 2, face % 2);
    for (int i = 0; i < 4; ++i) {
      if (is_inside(corners[i]) || !is_inside(corners[(i + 1) % 4])) continue;
      int j = (i + 1) % 4;
      while (is_inside(corners[(j + 1) % 4])) j = (j + 1) % 4;
      next[EdgeBetween(corners[i], corners[(i + 1) % 4])] = EdgeBetween(corners[j], corners[(j + 1) % 4]);
    }
  }
  return next;
}

/// Triangulates the polygon with as few diagonals on the cell's faces as possible: the neighbouring cell may have the
/// same diagonal, so that four triangles would share an edge. Returns the number of such diagonals.
int Triangulate(std::span<const int> polygon, Triangles& triangles) {
  if (polygon.size() < 3) return 0;
  const auto cost_of = [](int a, int b) { return (FacesOfEdge(a) & FacesOfEdge(b)) != 0 ? 1 : 0; };
  const std::size_t last = polygon.size() - 1;
  int least = std::numeric_limits<int>::max();
  Triangles best;
  for (std::size_t apex = 1; apex < last; ++apex) {
    Triangles found;
    int cost = Triangulate(polygon.first(apex + 1), found) + Triangulate(polygon.subspan(apex), found);
    if (apex > 1) cost += cost_of(polygon[0], polygon[apex]);
    if (apex + 1 < last) cost += cost_of(polygon[apex], polygon[last]);
    if (cost >= least) continue;
    least = cost;
    found.push_back({static_cast<std::uint8_t>(polygon[0]), static_cast<std::uint8_t>(polygon[apex]),
                     static_cast<std::uint8_t>(polygon[last])});
    best = std::move(found);
  }
  triangles.insert(triangles.end(), best.begin(), best.end());
  return least;
}

CellCase MakeCase(unsigned inside) {
  CellCase result;
  std::array<int, kCellEdges> next = LinkEdges(inside);
  Triangles triangles;
  for (int start = 0; start < kCellEdges; ++start) {
    std::vector<int> polygon;
    for (int edge = start; next[edge] >= 0;) {
      polygon.push_back(edge);
      result.edges = static_cast<std::uint16_t>(result.edges | 1u << edge);
      const int following = next[edge];
      next[edge] = -1;
      edge = following;
    }
    Triangulate(polygon, triangles);
  }
  result.num_triangles = static_cast<std::uint8_t>(triangles.size());
  std::copy(triangles.begin(), triangles.end(), result.triangles.begin());
  return result;
}

}  // namespace

const std::array<CellEdge, kCellEdges>& CellEdgeTable() {
  static const auto table = [] {
    std::array<CellEdge, kCellEdges> edges;
    for (int corner = 0; corner < kCellCorners; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) continue;
        edges[EdgeBetween(corner, corner | 1 << axis)] = {static_cast<std::uint8_t>(corner),
                                                          static_cast<std::uint8_t>(axis)};
      }
    }
    return edges;
  }();
  return table;
}

const CellCaseTable& CellCases() {
  static const auto table = [] {
    CellCaseTable cases;
    for (unsigned inside = 0; inside < cases.size(); ++inside) cases[inside] = MakeCase(inside);
    return cases;
  }();
  return table;
}

}  // namespace dhpmap
