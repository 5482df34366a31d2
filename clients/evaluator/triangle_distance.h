// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "clients/evaluator/nearest_sample.h"
#include "clients/evaluator/surface_samples.h"

namespace dhpmap::evaluator {

/// From a point to the nearest point of a triangle.
float DistanceToTriangle(const Eigen::Vector3f& p_m, const Eigen::Vector3f& a_m, const Eigen::Vector3f& b_m,
                         const Eigen::Vector3f& c_m);

/// Replaces the distances from queries to their nearest samples by those to the triangles that the samples lie on:
/// between two sets of samples of one and the same surface there is half a spacing, which would hide how near surfaces
/// really are. Never larger than before. `samples` and the neighbours' indices must be those of `mesh`.
void MeasureToTriangles(const std::vector<Eigen::Vector3f>& queries_m, const Mesh& mesh, const SurfaceSamples& samples,
                        std::span<Neighbour> neighbours);

}  // namespace dhpmap::evaluator
