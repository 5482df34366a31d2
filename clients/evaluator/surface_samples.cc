// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/surface_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace dhpmap::evaluator {
namespace {

/// A low-discrepancy sequence in the unit square (the additive recurrence of the plastic number).
class SpreadPoints {
 public:
  std::array<double, 2> Next() {
    u_ += 0.7548776662466927;
    v_ += 0.5698402909980532;
    u_ -= std::floor(u_);
    v_ -= std::floor(v_);
    return {u_, v_};
  }

 private:
  double u_ = 0.5, v_ = 0.5;
};

}  // namespace

SurfaceSamples SampleSurface(const Mesh& mesh, double spacing_m) {
  SurfaceSamples samples;
  SpreadPoints spread;
  double owed = 0.5;  // samples; small triangles pass their fraction on to the next
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const Eigen::Vector3d a = mesh.vertices_m[triangle[0]].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices_m[triangle[1]].cast<double>() - a;
    const Eigen::Vector3d ac = mesh.vertices_m[triangle[2]].cast<double>() - a;
    owed += 0.5 * ab.cross(ac).norm() / (spacing_m * spacing_m);
    for (; owed >= 1.0; owed -= 1.0) {
      auto [u, v] = spread.Next();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Eigen::Vector3f p_m = (a + u * ab + v * ac).cast<float>();
      const std::uint32_t corner =
          *std::min_element(triangle.begin(), triangle.end(), [&](std::uint32_t i, std::uint32_t j) {
            return (mesh.vertices_m[i] - p_m).squaredNorm() < (mesh.vertices_m[j] - p_m).squaredNorm();
          });
      samples.positions_m.push_back(p_m);
      samples.classes.push_back(mesh.classes[corner]);
      samples.instances.push_back(mesh.instances[corner]);
      samples.triangles.push_back(t);
    }
  }
  return samples;
}

}  // namespace dhpmap::evaluator
