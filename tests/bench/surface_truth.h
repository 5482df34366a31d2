// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <span>
#include <unordered_map>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/mesh/mesh.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::bench {

// What a mesh and depth images say of places, by code that the queries have no part in.

/// Distances to the triangles of a mesh, each triangle measured with a formula of its own.
class MeshTruth {
 public:
  /// The mesh outlives it.
  explicit MeshTruth(const Mesh& mesh);
  [[nodiscard]] bool empty() const { return areas_.empty() || areas_.back() <= 0; }
  /// To the nearest triangle, or `limit_m` if there is none nearer.
  [[nodiscard]] double Distance(const Eigen::Vector3d& p, double limit_m) const;
  /// A point of the surface, all parts as likely.
  [[nodiscard]] Eigen::Vector3d Sample(std::mt19937& random) const;

 private:
  const Mesh& mesh_;
  std::unordered_map<BlockIndex, std::vector<std::uint32_t>, BlockIndexHash> cubes_;  ///< triangles whose box meets it
  std::vector<double> areas_;                                                         ///< of all up to each
};

/// What depth images saw of a place.
struct DepthView {
  bool is_measured = false;        ///< some image has something there
  bool is_looked_through = false;  ///< some image sees what is farther in the pixel that shows it
};
/// `near_m`: of what is measured, from the place.
DepthView LookAt(std::span<const PanopticFrame> frames, const Eigen::Vector3d& p, double near_m, double most_depth_m);

/// Points that depth images measured, at random. `most_depth_m`: along the optical axis.
std::vector<Eigen::Vector3d> MeasuredPoints(std::span<const PanopticFrame> frames, std::size_t count,
                                            double most_depth_m, std::mt19937& random);

}  // namespace dhpmap::bench
