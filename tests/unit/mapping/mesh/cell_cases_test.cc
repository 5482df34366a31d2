// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/cell_cases.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace dhpmap {
namespace {

Eigen::Vector3d Corner(int c) { return Eigen::Vector3d(c & 1, c >> 1 & 1, c >> 2 & 1); }

Eigen::Vector3d MidPoint(int edge) {
  const CellEdge& e = CellEdgeTable()[edge];
  return Corner(e.corner) + 0.5 * Eigen::Vector3d::Unit(e.axis);
}

/// Both lie in one face of the cell.
bool ShareFace(int edge_a, int edge_b) {
  const Eigen::Vector3d a = MidPoint(edge_a), b = MidPoint(edge_b);
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] == b[axis] && a[axis] != 0.5) return true;
  }
  return false;
}

using DirectedEdges = std::map<std::pair<int, int>, int>;

DirectedEdges CountDirectedEdges(const CellCase& cell) {
  DirectedEdges count;
  for (int i = 0; i < cell.num_triangles; ++i) {
    const auto& t = cell.triangles[i];
    for (int k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
  }
  return count;
}

TEST(CellCases, CrossExactlyTheEdgesWithOneEndInside) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    for (int edge = 0; edge < kCellEdges; ++edge) {
      const CellEdge& e = CellEdgeTable()[edge];
      const bool crosses = ((inside >> e.corner) & 1) != ((inside >> (e.corner | 1 << e.axis)) & 1);
      EXPECT_EQ((CellCases()[inside].edges >> edge & 1) != 0, crosses) << inside << " edge " << edge;
    }
  }
}

TEST(CellCases, UseEveryCrossedEdgeAndNoOther) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    const CellCase& cell = CellCases()[inside];
    unsigned used = 0;
    for (int i = 0; i < cell.num_triangles; ++i) {
      for (const int edge : cell.triangles[i]) used |= 1u << edge;
    }
    EXPECT_EQ(used, cell.edges) << inside;
  }
}

TEST(CellCases, AreSurfacesWhoseBorderLiesInTheFacesOfTheCell) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    const DirectedEdges count = CountDirectedEdges(CellCases()[inside]);
    for (const auto& [edge, times] : count) {
      EXPECT_EQ(times, 1) << inside;
      const bool has_mate = count.contains({edge.second, edge.first});
      EXPECT_TRUE(has_mate || ShareFace(edge.first, edge.second)) << inside << ": a hole inside the cell";
      // An inner diagonal in a face could be drawn by the neighbour too, and four triangles would meet there.
      EXPECT_FALSE(has_mate && ShareFace(edge.first, edge.second)) << inside << ": a diagonal in a face";
    }
  }
}

/// The border of the case on one face of the cell, as directed pairs of points in the plane of the face.
std::set<std::pair<std::pair<double, double>, std::pair<double, double>>> BorderOnFace(unsigned inside, int axis,
                                                                                       double side) {
  std::set<std::pair<std::pair<double, double>, std::pair<double, double>>> border;
  const DirectedEdges count = CountDirectedEdges(CellCases()[inside]);
  for (const auto& [edge, times] : count) {
    const Eigen::Vector3d a = MidPoint(edge.first), b = MidPoint(edge.second);
    if (count.contains({edge.second, edge.first}) || a[axis] != side || b[axis] != side) continue;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    border.insert({{a[u], a[v]}, {b[u], b[v]}});
  }
  return border;
}

TEST(CellCases, AgreeOnTheFaceBetweenTwoCells) {
  for (int axis = 0; axis < 3; ++axis) {
    for (unsigned low = 0; low < 256; ++low) {
      for (unsigned high = 0; high < 256; ++high) {
        bool share = true;
        for (int c = 0; c < kCellCorners; ++c) {
          if ((c >> axis & 1) == 0 && (high >> c & 1) != (low >> (c | 1 << axis) & 1)) share = false;
        }
        if (!share || high % 8 != low % 8) continue;  // every eighth partner: enough, and quick
        auto reversed = BorderOnFace(high, axis, 0.0);
        decltype(reversed) expected;
        for (const auto& [a, b] : reversed) expected.insert({b, a});
        EXPECT_EQ(BorderOnFace(low, axis, 1.0), expected) << low << " below " << high << " along " << axis;
      }
    }
  }
}

TEST(CellCases, FaceOutOfTheInside) {
  for (int corner = 0; corner < kCellCorners; ++corner) {
    const CellCase& cell = CellCases()[1u << corner];
    ASSERT_EQ(cell.num_triangles, 1);
    const Eigen::Vector3d a = MidPoint(cell.triangles[0][0]), b = MidPoint(cell.triangles[0][1]),
                          c = MidPoint(cell.triangles[0][2]);
    EXPECT_GT((b - a).cross(c - a).dot(a - Corner(corner)), 0) << corner;
  }
}

}  // namespace
}  // namespace dhpmap
