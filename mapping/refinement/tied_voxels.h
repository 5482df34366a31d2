// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/base/ids.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {

/// Where two objects touch, a voxel may have seen both as often, and hold the mean of both distances. Neighbours of a
/// kind say little of it then: one just within a ball goes to the floor with its surface, which is the ball's, and is
/// left in the air when the ball is taken away. Such a voxel goes to the one of those it has seen as often whose
/// surface it continues: that holds a neighbour (of six) on the other side of the surface, while who is likeliest holds
/// none; within 0.01 voxels of the surface a voxel is on neither side. Of several, to the one with the most such
/// neighbours; of these, to the smallest id.
///
/// `likeliest`: a label a member, read as it was and written.
void KeepTiedWithTheirSurface(const TileProblem& problem, std::span<SubmapId> likeliest);

}  // namespace dhpmap
