// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mapping/voxels/block_entry.h"

namespace dhpmap {

/// What the voxels of a tile have seen, summed up: LabelTotals without the classes that nobody has seen.
struct TileLabels {
  std::vector<std::pair<std::uint32_t, std::uint64_t>> classes;  ///< counts, by ascending id
  std::uint64_t own = 0, instances = 0;                          ///< see LabelTotals

  void AddTo(LabelTotals& totals) const;
  /// Whether it is no more than what TilePage counts for a tile on the disk.
  [[nodiscard]] bool IsShort() const { return classes.size() <= 8; }
  bool operator==(const TileLabels&) const = default;
};

/// Of blocks of one tile.
TileLabels LabelsOf(std::span<const BlockEntry> blocks);

/// The labels of a tile, once somebody has counted. Whoever reads the tile may keep what was found, several at once, as
/// all find the same; to forget it is for who writes. Thread-compatible beyond that.
class KeptTileLabels {
 public:
  KeptTileLabels() = default;
  KeptTileLabels(const KeptTileLabels& other) = delete;
  KeptTileLabels(KeptTileLabels&& other) noexcept : kept_(other.kept_.exchange(nullptr)) {}
  KeptTileLabels& operator=(KeptTileLabels&& other) noexcept {
    if (this != &other) delete kept_.exchange(other.kept_.exchange(nullptr));
    return *this;
  }
  ~KeptTileLabels() { Forget(); }

  /// Null if nobody has.
  [[nodiscard]] const TileLabels* Find() const { return kept_.load(std::memory_order_acquire); }
  void Keep(TileLabels labels) const;
  void Forget() {
    if (kept_.load(std::memory_order_relaxed) != nullptr) delete kept_.exchange(nullptr);
  }
  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  mutable std::atomic<const TileLabels*> kept_ = nullptr;
};

}  // namespace dhpmap
