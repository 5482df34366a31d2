// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/base/ids.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {

/// Resolves ties between two objects that touch. There a voxel may have equal counts of both, and the mean of both
/// distances. The labels of its neighbours then decide little: a voxel just inside a ball could go to the floor
/// together with the ball's surface, and would stay in the air when the ball is removed. Such a voxel goes to the
/// object with equal counts whose surface it continues: that object holds a neighbour (of six) on the other side of the
/// surface, while the likeliest object holds none. Within 0.01 voxels of the surface a voxel is on neither side. Among
/// several objects, the one with the most such neighbours gets the voxel; then the smallest id.
///
/// `likeliest`: one label per member; input and output.
void KeepTiedWithTheirSurface(const TileProblem& problem, std::span<SubmapId> likeliest);

}  // namespace dhpmap
