// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "mapping/mesh/mesh.h"

namespace dhpmap::testing {

inline void ExpectPlanesMatch(const Mesh& mesh) {
  const std::size_t n = mesh.vertices_m.size();
  EXPECT_EQ(mesh.normals.size(), n);
  EXPECT_EQ(mesh.colors.size(), n);
  EXPECT_EQ(mesh.classes.size(), n);
  EXPECT_EQ(mesh.instances.size(), n);
  std::vector<bool> is_used(n);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      ASSERT_LT(vertex, n);
      is_used[vertex] = true;
    }
  }
  EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0) << "vertices without a triangle";
}

/// Every edge in exactly two triangles, once in each direction. Returns the number of edges.
inline std::size_t ExpectWatertight(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
  }
  int num_bad = 0;
  for (const auto& [edge, count] : directed) {
    const auto mate = directed.find({edge.second, edge.first});
    num_bad += count != 1 || mate == directed.end() || mate->second != 1;
  }
  EXPECT_EQ(num_bad, 0);
  return directed.size() / 2;
}

inline long EulerCharacteristic(const Mesh& mesh) {
  return static_cast<long>(mesh.vertices_m.size()) - static_cast<long>(ExpectWatertight(mesh)) +
         static_cast<long>(mesh.triangles.size());
}

inline Eigen::Vector3f FaceNormal(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const auto& v = mesh.vertices_m;
  return (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
}

inline double Area_m2(const Mesh& mesh) {
  double area_m2 = 0;
  for (const auto& t : mesh.triangles) area_m2 += 0.5 * FaceNormal(mesh, t).norm();
  return area_m2;
}

}  // namespace dhpmap::testing
