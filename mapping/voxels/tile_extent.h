// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>

#include "mapping/voxels/block_entry.h"

namespace dhpmap {

/// Around the observed voxels of a tile, or of some of its blocks: half-open, in voxels from the tile's lowest corner.
struct TileExtent {
  std::array<std::uint8_t, 3> low{}, high{};  ///< all 0: none is observed

  [[nodiscard]] bool IsEmpty() const { return high[0] == 0; }
  void Add(const TileExtent& other);

  /// 43 bits, never 0; see storage/FORMAT.md.
  [[nodiscard]] std::uint64_t Code() const;
  /// Nothing for 0, which says that it is not known, and for what is no code.
  static std::optional<TileExtent> FromCode(std::uint64_t code);

  constexpr bool operator==(const TileExtent&) const = default;
};

/// Of blocks of one tile.
TileExtent ExtentOf(std::span<const BlockEntry> blocks);

/// The extent of a tile, once somebody has looked. Whoever reads the tile may keep what was found, several at once, as
/// all find the same; to forget it is for who writes. Thread-compatible beyond that.
class KeptTileExtent {
 public:
  explicit KeptTileExtent(std::uint64_t code = 0) : code_(code) {}
  KeptTileExtent(const KeptTileExtent& other) noexcept : code_(other.code()) {}
  KeptTileExtent& operator=(const KeptTileExtent& other) noexcept {
    code_.store(other.code(), std::memory_order_relaxed);
    return *this;
  }

  /// Nothing if nobody has.
  [[nodiscard]] std::optional<TileExtent> Find() const { return TileExtent::FromCode(code()); }
  /// Likewise, 0.
  [[nodiscard]] std::uint64_t code() const { return code_.load(std::memory_order_relaxed); }
  void Keep(const TileExtent& extent) const { code_.store(extent.Code(), std::memory_order_relaxed); }
  void Forget() { code_.store(0, std::memory_order_relaxed); }

 private:
  mutable std::atomic<std::uint64_t> code_;
};

}  // namespace dhpmap
