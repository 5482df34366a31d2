// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/gone_block.h"

#include <bit>

namespace dhpmap {

bool GoneBlock::empty() const {
  std::uint64_t any = 0;
  for (std::size_t z = 0; z < low_.size(); ++z) any |= low_[z] | high_[z];
  return any == 0;
}

VoxelMask GoneBlock::Contradicted() const {
  VoxelMask mask;
  for (std::size_t z = 0; z < mask.size(); ++z) mask[z] = low_[z] & high_[z];
  return mask;
}

bool GoneBlock::IsDistinct(const Viewpoint& view) const {
  if (empty()) return true;
  if ((view.position_m - last_.position_m).squaredNorm() >= kDistinct_m * kDistinct_m) return true;
  // Clients choose stamps, so a signed difference may overflow; the unsigned one does not.
  const auto now = static_cast<std::uint64_t>(view.stamp_ns), then = static_cast<std::uint64_t>(last_.stamp_ns);
  return (view.stamp_ns > last_.stamp_ns ? now - then : then - now) >= static_cast<std::uint64_t>(kDistinct_ns);
}

int GoneBlock::Raise(const VoxelMask& voxels, const Viewpoint& view) {
  int num_became = 0;
  for (std::size_t z = 0; z < voxels.size(); ++z) {
    const std::uint64_t counts = voxels[z] & ~(low_[z] & high_[z]);
    const std::uint64_t carry = low_[z] & counts;
    low_[z] ^= counts;
    high_[z] ^= carry;
    num_became += std::popcount(low_[z] & high_[z] & counts);
  }
  last_ = view;
  return num_became;
}

void GoneBlock::Set(int linear, int count) {
  const auto z = static_cast<std::size_t>(linear >> 6);
  const int bit = linear & 63;
  const std::uint64_t others = ~(std::uint64_t{1} << bit);
  low_[z] = (low_[z] & others) | static_cast<std::uint64_t>(count & 1) << bit;
  high_[z] = (high_[z] & others) | static_cast<std::uint64_t>(count >> 1) << bit;
}

bool GoneBlock::operator==(const GoneBlock& other) const {
  return low_ == other.low_ && high_ == other.high_ && last_.position_m == other.last_.position_m &&
         last_.stamp_ns == other.last_.stamp_ns;
}

}  // namespace dhpmap
