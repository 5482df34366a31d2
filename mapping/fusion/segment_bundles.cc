// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/segment_bundles.h"

#include <algorithm>

#include "mapping/base/memory_count.h"

namespace dhpmap {
namespace {

std::size_t NextPowerOfTwo(std::size_t n) {
  std::size_t power = 16;
  while (power < n) power *= 2;
  return power;
}

std::size_t SlotHash(BlockIndex block, std::size_t mask) { return BlockIndexHash{}(block)&mask; }

}  // namespace

void BundleCell::CountBundles() {
  num_bundles = 0;
  for (std::size_t word = 0; word < ends.size(); ++word) {
    up_to[word] = static_cast<std::uint16_t>(num_bundles);
    num_bundles += static_cast<std::uint32_t>(std::popcount(ends[word]));
  }
}

void BundleCell::AddBundle(int linear) {
  SetIn(ends, linear, true);
  ++num_bundles;
  for (auto word = static_cast<std::size_t>(linear >> 6) + 1; word < up_to.size(); ++word) ++up_to[word];
}

const BundleCell* SegmentBundles::Find(BlockIndex block) const {
  if (slots_.empty()) return nullptr;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = SlotHash(block, mask); slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (cells[slots_[slot] - 1].block == block) return &cells[slots_[slot] - 1];
  }
  return nullptr;
}

bool SegmentBundles::EndsIn(VoxelIndex voxel) const {
  const BundleCell* cell = Find(BlockOf(voxel));
  return cell != nullptr && IsIn(cell->ends, LinearIndex(voxel));
}

BundleCell& SegmentBundles::FindOrInsert(BlockIndex block) {
  if (2 * (cells.size() + 1) > slots_.size()) {
    slots_.assign(NextPowerOfTwo(4 * (cells.size() + 1)), 0);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::size_t slot = SlotHash(cells[i].block, mask);
      while (slots_[slot] != 0) slot = (slot + 1) & mask;
      slots_[slot] = static_cast<std::uint32_t>(i + 1);
    }
  }
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = SlotHash(block, mask);
  for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (cells[slots_[slot] - 1].block == block) return cells[slots_[slot] - 1];
  }
  cells.push_back({.block = block});
  slots_[slot] = static_cast<std::uint32_t>(cells.size());
  return cells.back();
}

bool SegmentBundles::Append(BlockIndex block, const Bundle& bundle) {
  BundleCell& cell = FindOrInsert(block);
  const bool is_new = cell.num_bundles == 0;
  if (is_new) cell.first_bundle = static_cast<std::uint32_t>(bundles.size());
  cell.AddBundle(bundle.linear);
  bundles.push_back(bundle);
  num_points += bundle.num_points;
  return is_new;
}

void SegmentBundles::Reset() {
  row = -1;
  is_cut_short = false;
  num_points = 0;
  cells.clear();
  bundles.clear();
  std::fill(slots_.begin(), slots_.end(), 0);
}

std::size_t SegmentBundles::BufferBytes() const {
  return CapacityBytes(cells) + CapacityBytes(bundles) + CapacityBytes(slots_);
}

std::vector<SegmentBundles> CutShortSegments(std::size_t num_rows) {
  std::vector<SegmentBundles> segments(num_rows + 1);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    segments[i].row = static_cast<int>(i) - 1;
    segments[i].is_cut_short = true;
  }
  return segments;
}

}  // namespace dhpmap
