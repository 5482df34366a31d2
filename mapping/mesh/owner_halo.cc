// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/owner_halo.h"

#include <algorithm>

namespace dhpmap {
namespace {

constexpr int kNumCorners = 18;
constexpr std::uint32_t kNobody = 0;

}  // namespace

bool OwnerHalo::IsNeeded(const SurfaceField& field, const Halo::Blocks& blocks) {
  const Submap* first = nullptr;
  for (const BlockEntry* entry : blocks) {
    if (entry == nullptr) continue;
    const Submap* holder = field.SoleHolder(field.NumberOf(*entry));
    if (holder == nullptr || (first != nullptr && holder != first)) return true;
    first = holder;
  }
  return false;
}

OwnerHalo::OwnerHalo(const SurfaceField& field, const Halo::Blocks& blocks) {
  Halo::VisitRows(blocks, [&](const BlockEntry& entry, int linear, int position, auto count) {
    const std::size_t block = field.NumberOf(entry);
    for (int i = 0; i < count; ++i) {
      if (!entry.tsdf->IsObserved(linear + i)) continue;
      const SubmapInfo& info = field.HolderAt(block, linear + i).submap->info();
      owner_[position + i] = info.panoptic == Panoptic::kUnknown ? kNobody : info.id.value;
    }
  });
}

int OwnerHalo::Labelling(int nearer, int farther, int axis) const {
  const int b = Halo::kStride[(axis + 1) % 3], c = Halo::kStride[(axis + 2) % 3];
  const std::array<int, kNumCorners / 2> steps = {0, b, -b, c, -c, b + c, b - c, c - b, -b - c};
  std::array<int, kNumCorners> corners;  // in order of preference
  for (std::size_t i = 0; i < steps.size(); ++i) {
    corners[2 * i] = nearer + steps[i];
    corners[2 * i + 1] = farther + steps[i];
  }
  const auto count_of = [&](std::uint32_t owner) {
    return std::count_if(corners.begin(), corners.end(), [&](int corner) { return owner_[corner] == owner; });
  };
  int best = nearer;
  auto most = owner_[nearer] == kNobody ? 0 : count_of(owner_[nearer]);
  for (std::size_t i = 1; i < kNumCorners && 2 * most < kNumCorners; ++i) {
    const std::uint32_t owner = owner_[corners[i]];
    if (owner == kNobody || owner == owner_[best]) continue;
    const auto count = count_of(owner);
    if (count <= most) continue;
    best = corners[i];
    most = count;
  }
  return best;
}

}  // namespace dhpmap
