// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/base/ids.h"
#include "mapping/voxels/block_table.h"
#include "mapping/voxels/label_block.h"
#include "mapping/voxels/voxel_average.h"

namespace dhpmap {

/// What all submaps together know of one voxel position (paper II-D): weighted averages and added counts.
struct MergedVoxel {
  int num_holders = 0;
  SubmapId first_holder;  ///< the smallest; the unknown submap only where it is alone
  MergedAverage<double> tsdf;
  std::vector<LabelCount> classes;     ///< by ascending id
  std::vector<SubmapCount> instances;  ///< likewise
};

/// Adds what `holder` has in its block at `linear`; must be observed. Call by ascending holder.
void Accumulate(const BlockEntry& block, SubmapId holder, int linear, MergedVoxel& merged);

/// Writes the merged voxel to the blocks of submap `owner`.
void Store(const MergedVoxel& merged, SubmapId owner, int linear, TsdfBlock& tsdf, LabelBlock& labels);

/// Makes the voxel unobserved and empties its labels.
void Clear(int linear, TsdfBlock& tsdf, LabelBlock& labels);

/// True if some voxel of the block has seen another instance more often than its own submap, which does not hold it by
/// conclusion.
bool HasForeignVoxel(const LabelBlock& labels);

}  // namespace dhpmap
