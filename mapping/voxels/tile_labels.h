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

/// The label counts of a tile's voxels, summed up: LabelTotals without the classes that have no count.
struct TileLabels {
  std::vector<std::pair<std::uint32_t, std::uint64_t>> classes;  ///< counts, by ascending id
  std::uint64_t own = 0, instances = 0;                          ///< see LabelTotals

  void AddTo(LabelTotals& totals) const;
  /// Whether it fits into the memory that TilePage counts for a tile on disk.
  [[nodiscard]] bool IsShort() const { return classes.size() <= 8; }
  bool operator==(const TileLabels&) const = default;
};

/// Of blocks of one tile.
TileLabels LabelsOf(std::span<const BlockEntry> blocks);

/// A cache for the label counts of a tile. Several readers of the tile may call Keep concurrently, because all have the
/// same counts. Only the writer calls Forget. Otherwise thread-compatible.
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

  /// Null if nothing is cached.
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
