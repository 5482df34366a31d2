// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>

#include "mapping/voxels/block_entry.h"

namespace dhpmap {

/// Bounds of the observed voxels of a tile, or of some of its blocks: half-open, in voxels from the tile's lowest
/// corner.
struct TileExtent {
  std::array<std::uint8_t, 3> low{}, high{};  ///< all 0: none is observed

  [[nodiscard]] bool IsEmpty() const { return high[0] == 0; }
  void Add(const TileExtent& other);

  /// 43 bits, never 0; see storage/FORMAT.md.
  [[nodiscard]] std::uint64_t Code() const;
  /// Nothing for 0, which means unknown, and for invalid codes.
  static std::optional<TileExtent> FromCode(std::uint64_t code);

  constexpr bool operator==(const TileExtent&) const = default;
};

/// Of blocks of one tile.
TileExtent ExtentOf(std::span<const BlockEntry> blocks);

/// A cache for the extent of a tile. Several readers of the tile may call Keep concurrently, because all have the same
/// extent. Only the writer calls Forget. Otherwise thread-compatible.
class KeptTileExtent {
 public:
  explicit KeptTileExtent(std::uint64_t code = 0) : code_(code) {}
  KeptTileExtent(const KeptTileExtent& other) noexcept : code_(other.code()) {}
  KeptTileExtent& operator=(const KeptTileExtent& other) noexcept {
    code_.store(other.code(), std::memory_order_relaxed);
    return *this;
  }

  /// Nothing if nothing is cached.
  [[nodiscard]] std::optional<TileExtent> Find() const { return TileExtent::FromCode(code()); }
  /// 0 if nothing is cached.
  [[nodiscard]] std::uint64_t code() const { return code_.load(std::memory_order_relaxed); }
  void Keep(const TileExtent& extent) const { code_.store(extent.Code(), std::memory_order_relaxed); }
  void Forget() { code_.store(0, std::memory_order_relaxed); }

 private:
  mutable std::atomic<std::uint64_t> code_;
};

}  // namespace dhpmap
