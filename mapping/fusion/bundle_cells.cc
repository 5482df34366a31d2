// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/bundle_cells.h"

#include <cstddef>

#include "mapping/fusion/point_kernel.h"

namespace dhpmap {

void BundleRuns(std::span<const PointRun* const> runs, FrameTally& tally, std::vector<std::uint32_t>& cell_of,
                SegmentBundles& segment) {
  if (tally.is_too_large()) return;
  // First find the end voxels of each cell's bundles, so that a cell's bundles are contiguous; then sum up the runs.
  cell_of.resize(runs.size());
  BlockIndex last_block{};
  std::uint32_t last_cell = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const BlockIndex block = BlockOf(runs[i]->place.voxel());
    if (i == 0 || block != last_block) {
      const BundleCell* found = segment.Find(block);
      if (found == nullptr) {
        if (!tally.TakeCell()) return;
        found = &segment.FindOrInsert(block);
      }
      last_cell = static_cast<std::uint32_t>(found - segment.cells.data());
      last_block = block;
    }
    cell_of[i] = last_cell;
    SetIn(segment.cells[last_cell].ends, LinearIndex(runs[i]->place.voxel()), true);
  }
  std::uint32_t num_bundles = 0;
  for (BundleCell& cell : segment.cells) {
    cell.CountBundles();
    cell.first_bundle = num_bundles;
    num_bundles += cell.num_bundles;
  }
  segment.bundles.resize(num_bundles);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PointRun& run = *runs[i];
    const int linear = LinearIndex(run.place.voxel());
    Bundle& bundle = segment.bundles[segment.cells[cell_of[i]].BundleAt(linear)];
    bundle.linear = static_cast<std::uint16_t>(linear);
    bundle.weighted_sum_m += run.weighted_sum_m();
    bundle.weight += run.weight();
    bundle.weighted_color += run.color_sum();
    bundle.num_points += run.num_points();
    segment.num_points += run.num_points();
  }
  for (Bundle& bundle : segment.bundles) {
    // Points on all sides of the sensor cancel out: in the sensor's own voxel any direction will do.
    const float least = kLeastDepth_m * bundle.weight;
    if (!(bundle.weighted_sum_m.squaredNorm() >= least * least)) bundle.weighted_sum_m = {least, 0, 0};
  }
}

}  // namespace dhpmap
