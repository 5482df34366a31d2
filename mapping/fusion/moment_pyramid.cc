// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/moment_pyramid.h"

#include "mapping/base/memory_count.h"

namespace dhpmap {

namespace {

/// Index of the 2-voxel cube that contains a voxel of the block.
std::size_t CubeOf(std::uint16_t linear) {
  return static_cast<std::size_t>((linear >> 1 & 3) | (linear >> 2 & 12) | (linear >> 3 & 48));
}

}  // namespace

PlaneMoments& StableMoments::Add() {
  if (size_ == chunks_.size() * kChunk) chunks_.push_back(std::make_unique_for_overwrite<Chunk>());
  PlaneMoments& added = (*this)[size_++];
  added = {};
  return added;
}

std::size_t StableMoments::BufferBytes() const { return CapacityBytes(chunks_) + chunks_.size() * sizeof(Chunk); }

std::size_t MomentPyramid::BufferBytes() const {
  return CapacityBytes(blocks_) + cubes_.BufferBytes() + coarse_.BufferBytes();
}

void MomentPyramid::Build(const SegmentBundles& segment) {
  blocks_.assign(segment.cells.size(), {});
  cubes_.Clear();
  coarse_.Clear();
  for (std::size_t c = 0; c < segment.cells.size(); ++c) {
    const BundleCell& cell = segment.cells[c];
    Block& block = blocks_[c];
    block.first_cube = static_cast<std::uint32_t>(cubes_.size());
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const Bundle& bundle = segment.bundles[b];
      std::uint8_t& slot = block.slot[CubeOf(bundle.linear)];
      if (slot == 0) {
        cubes_.Add();
        slot = static_cast<std::uint8_t>(cubes_.size() - block.first_cube);
      }
      cubes_[block.first_cube + slot - 1u].Add(bundle.weighted_sum_m, bundle.weight);
    }
  }
}

const PlaneMoments* MomentPyramid::Find(std::size_t cell, int level, std::size_t cube) {
  Block& block = blocks_[cell];
  if (level == 1) {
    const std::uint8_t slot = block.slot[cube];
    return slot == 0 ? nullptr : &cubes_[block.first_cube + slot - 1u];
  }
  if (block.coarse_slot[0] == kNotSummed) SumUp(block);
  if (level == 3) return &coarse_[block.first_coarse];
  const std::uint8_t slot = block.coarse_slot[cube];
  return slot == 0 ? nullptr : &coarse_[block.first_coarse + slot];
}

void MomentPyramid::SumUp(Block& block) {
  block.first_coarse = static_cast<std::uint32_t>(coarse_.size());
  block.coarse_slot.fill(0);
  PlaneMoments& all = coarse_.Add();
  for (std::size_t i = 0; i < block.slot.size(); ++i) {
    if (block.slot[i] == 0) continue;
    std::uint8_t& slot = block.coarse_slot[(i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4)];  // the upper bits of x, y and z
    if (slot == 0) {
      coarse_.Add();
      slot = static_cast<std::uint8_t>(coarse_.size() - 1 - block.first_coarse);
    }
    const PlaneMoments& cube = cubes_[block.first_cube + block.slot[i] - 1u];
    coarse_[block.first_coarse + slot].Add(cube);
    all.Add(cube);
  }
}

}  // namespace dhpmap
