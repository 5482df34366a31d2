// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/free/free_tile.h"

#include <algorithm>

namespace dhpmap {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

FreeMask Filled(std::uint64_t word) {
  FreeMask mask;
  mask.fill(word);
  return mask;
}

bool IsAll(const FreeMask& mask) {
  return std::all_of(mask.begin(), mask.end(), [](std::uint64_t word) { return word == kAll; });
}
bool IsNone(const FreeMask& mask) {
  return std::all_of(mask.begin(), mask.end(), [](std::uint64_t word) { return word == 0; });
}

/// Calls visit(cell) for each bit, in ascending order.
template <typename Visitor>
void ForEachBit(std::uint64_t bits, Visitor&& visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

}  // namespace

FreeMask FreeTile::MaskOf(int cell) const {
  const std::uint64_t bit = std::uint64_t{1} << cell;
  if ((full_ & bit) != 0) return Filled(kAll);
  return (mixed_ & bit) != 0 ? masks_[PositionOf(cell)] : Filled(0);
}

std::int64_t FreeTile::NumFreeVoxels() const {
  std::int64_t count = std::int64_t{kBlockVoxels} * std::popcount(full_);
  for (const FreeMask& mask : masks_) {
    for (const std::uint64_t word : mask) count += std::popcount(word);
  }
  return count;
}

bool FreeTile::Holds(const FreeBlocks& seen) const {
  if ((seen.full & ~full_) != 0) return false;
  bool holds = true;
  ForEachBit(seen.mixed & ~full_, [&](int cell) {
    const FreeMask mask = MaskOf(cell);
    const FreeMask& added = seen.masks[static_cast<std::size_t>(cell)];
    for (std::size_t z = 0; z < mask.size(); ++z) holds = holds && (added[z] & ~mask[z]) == 0;
  });
  return holds;
}

void FreeTile::Add(const FreeBlocks& seen) {
  Rewrite(full_ | seen.full, mixed_ | seen.mixed, [&seen](int cell, FreeMask& mask) {
    if ((seen.mixed >> cell & 1u) == 0) return;
    const FreeMask& added = seen.masks[static_cast<std::size_t>(cell)];
    for (std::size_t z = 0; z < mask.size(); ++z) mask[z] |= added[z];
  });
}

void FreeTile::Remove(const FreeBlocks& gone) {
  const std::uint64_t in_part = full_ & gone.mixed;
  Rewrite(full_ & ~gone.full & ~in_part, (mixed_ | in_part) & ~gone.full, [&gone](int cell, FreeMask& mask) {
    if ((gone.mixed >> cell & 1u) == 0) return;
    const FreeMask& taken = gone.masks[static_cast<std::size_t>(cell)];
    for (std::size_t z = 0; z < mask.size(); ++z) mask[z] &= ~taken[z];
  });
}

template <typename Change>
void FreeTile::Rewrite(std::uint64_t full, std::uint64_t in_part, Change&& change) {
  std::uint64_t mixed = 0;
  std::vector<FreeMask> masks;
  masks.reserve(static_cast<std::size_t>(std::popcount(in_part & ~full)));
  ForEachBit(in_part & ~full, [&](int cell) {
    const std::uint64_t bit = std::uint64_t{1} << cell;
    FreeMask mask = MaskOf(cell);
    change(cell, mask);
    if (IsAll(mask)) {
      full |= bit;
    } else if (!IsNone(mask)) {
      mixed |= bit;
      masks.push_back(mask);
    }
  });
  full_ = full;
  mixed_ = mixed;
  masks_ = std::move(masks);
}

}  // namespace dhpmap
