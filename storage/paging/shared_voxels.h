// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mapping/voxels/block_table.h"
#include "storage/store.h"

namespace dhpmap {

/// Counts and locates voxels that several inactive objects hold. Needs at most about 100 MB.
class SharedVoxels {
 public:
  /// Adds a tile of an object; call once for each.
  void Add(SubmapId id, const BlockTile& tile) {
    for (const BlockEntry& entry : tile.entries()) {
      if (entry.tsdf != nullptr) AddBlock(id, entry);
    }
  }
  /// -1: too many blocks to count.
  [[nodiscard]] std::int64_t num_shared() const { return is_too_large_ ? -1 : num_shared_; }
  /// The first VerifyReport::kMaxSharedPlaces of them.
  [[nodiscard]] const std::vector<SharedPlace>& places() const { return places_; }

 private:
  using Voxels = std::bitset<kBlockVoxels>;
  struct Holder {
    SubmapId id;
    Voxels voxels;
  };

  void AddBlock(SubmapId id, const BlockEntry& entry) {
    Voxels shown;
    for (int v = 0; v < kBlockVoxels; ++v) {
      if (entry.Shows(v)) shown.set(static_cast<std::size_t>(v));
    }
    if (shown.none()) return;
    if (num_held_ >= kMaxHeld) {
      is_too_large_ = true;
      return;
    }
    std::vector<Holder>& holders = held_[entry.index];
    Voxels before;
    for (const Holder& holder : holders) {
      before |= holder.voxels;
      const auto num_voxels = static_cast<std::int64_t>((holder.voxels & shown).count());
      if (num_voxels == 0 || places_.size() >= VerifyReport::kMaxSharedPlaces) continue;
      places_.push_back({.first = holder.id, .second = id, .block = entry.index, .num_voxels = num_voxels});
    }
    num_shared_ += static_cast<std::int64_t>((before & shown).count());
    holders.push_back({id, shown});
    ++num_held_;
  }

  static constexpr std::size_t kMaxHeld = 1 << 20;
  std::unordered_map<BlockIndex, std::vector<Holder>, BlockIndexHash> held_;
  std::size_t num_held_ = 0;
  std::int64_t num_shared_ = 0;
  std::vector<SharedPlace> places_;
  bool is_too_large_ = false;
};

}  // namespace dhpmap
