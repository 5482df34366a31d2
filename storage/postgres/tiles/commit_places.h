// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "mapping/base/result.h"
#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"

namespace dhpmap::postgres {

/// The places of the submap and tile rows that commits wrote or erased. A follower reads the present rows at these
/// places. About 5 bytes a tile. Thread-compatible.
class CommitPlaces {
 public:
  /// The database keeps the places of at least this many recent commits of a map.
  static constexpr std::int64_t kNumKept = 1024;

  struct Owner {
    bool is_row_changed = false;  ///< a submap's row was written or erased
    bool is_emptied = false;      ///< it was erased with all its tiles; its present rows are newer
    /// By x, y, z; bit n: layer number n.
    std::map<std::array<std::int32_t, 3>, std::uint32_t> tiles;
  };

  void AddRow(std::int64_t owner) { owners_[owner].is_row_changed = true; }
  void AddTile(std::int64_t owner, TileIndex index, std::int64_t layer) {
    owners_[owner].tiles[{index.x, index.y, index.z}] |= std::uint32_t{1} << layer;
  }
  /// Marks all present tiles of the owner.
  void Empty(std::int64_t owner);

  /// By ascending owner (column tiles.owner_id).
  [[nodiscard]] const std::map<std::int64_t, Owner>& owners() const { return owners_; }
  /// Number of tile rows, one for each layer.
  [[nodiscard]] std::size_t NumTileRows() const;

  [[nodiscard]] Bytes Encode() const;
  /// Adds the places of a later commit. DATA_LOSS unless Encode made them.
  Status Add(ByteView encoded);

 private:
  std::map<std::int64_t, Owner> owners_;
};

}  // namespace dhpmap::postgres
