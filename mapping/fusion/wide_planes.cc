// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/wide_planes.h"

#include "mapping/base/memory_count.h"

namespace dhpmap {
namespace {

/// Side of a level's cubes, in voxels: 16, then 32.
constexpr int CubeSideLog2(std::size_t level) { return kBlockSideLog2 + 1 + static_cast<int>(level); }

}  // namespace

void WidePlanes::Reset() {
  if (is_summed_) *this = {};  // clearing large tables is slow, and few segments use them
}

const PlaneFit& WidePlanes::At(VoxelIndex voxel, const SegmentBundles& segment, MomentPyramid& pyramid,
                               float voxel_size_m) {
  if (!is_summed_) SumUp(segment, pyramid);
  const PlaneFit* fit = nullptr;
  for (std::size_t l = 0; l < kNumLevels; ++l) {
    Level& level = levels_[l];
    const int shift = CubeSideLog2(l), half = 1 << (shift - 1);
    const BlockIndex corner{(voxel.x + half) >> shift, (voxel.y + half) >> shift, (voxel.z + half) >> shift};
    std::uint32_t number = level.fit_of.Find(corner);
    if (number == IndexMap<BlockIndex>::kNone) {
      number = static_cast<std::uint32_t>(level.fits.size());
      level.fits.push_back(Fit(level, corner, voxel_size_m));
      level.fit_of.Set(corner, number);
    }
    fit = &level.fits[number];
    if (fit->outcome != PlaneFit::Outcome::kTooFew) break;
  }
  return *fit;
}

void WidePlanes::SumUp(const SegmentBundles& segment, MomentPyramid& pyramid) {
  is_summed_ = true;
  for (std::size_t c = 0; c < segment.cells.size(); ++c) {
    const BlockIndex block = segment.cells[c].block;
    for (std::size_t l = 0; l < kNumLevels; ++l) {
      Level& level = levels_[l];
      const int shift = CubeSideLog2(l) - kBlockSideLog2;
      const BlockIndex cube{block.x >> shift, block.y >> shift, block.z >> shift};
      std::uint32_t number = level.cube_of.Find(cube);
      if (number == IndexMap<BlockIndex>::kNone) {
        number = static_cast<std::uint32_t>(level.cubes.size());
        level.cubes.emplace_back();
        level.cube_of.Set(cube, number);
      }
      level.cubes[number].Add(*pyramid.Find(c, MomentPyramid::kNumLevels, 0));
    }
  }
}

PlaneFit WidePlanes::Fit(const Level& level, BlockIndex corner, float voxel_size_m) {
  PlaneMoments sum;
  for (int n = 0; n < 8; ++n) {
    const std::uint32_t cube =
        level.cube_of.Find({corner.x - 1 + (n & 1), corner.y - 1 + (n >> 1 & 1), corner.z - 1 + (n >> 2)});
    if (cube != IndexMap<BlockIndex>::kNone) sum.Add(level.cubes[cube]);
  }
  return FitPlane(sum, voxel_size_m);
}

std::size_t WidePlanes::BufferBytes() const {
  std::size_t bytes = 0;
  for (const Level& level : levels_) {
    bytes += level.cube_of.MemoryBytes() + level.fit_of.MemoryBytes() + CapacityBytes(level.cubes) +
             CapacityBytes(level.fits);
  }
  return bytes;
}

}  // namespace dhpmap
