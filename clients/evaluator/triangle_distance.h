// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "clients/evaluator/nearest_sample.h"
#include "clients/evaluator/surface_samples.h"

namespace dhpmap::evaluator {

/// The distance from a point to the nearest point of a triangle.
float DistanceToTriangle(const Eigen::Vector3f& p_m, const Eigen::Vector3f& a_m, const Eigen::Vector3f& b_m,
                         const Eigen::Vector3f& c_m);

/// Replaces distances from queries to their nearest samples by distances to the triangles of these samples. Two sets of
/// samples of the same surface are half a spacing apart, which would hide how close surfaces really are. Distances
/// never grow. `samples` and the neighbours' indices must be those of `mesh`.
void MeasureToTriangles(const std::vector<Eigen::Vector3f>& queries_m, const Mesh& mesh, const SurfaceSamples& samples,
                        std::span<Neighbour> neighbours);

}  // namespace dhpmap::evaluator
