// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/base/result.h"
#include "mapping/paging/tile_page.h"
#include "mapping/voxels/block_tile.h"

namespace dhpmap {

/// Takes evicted tiles that no store has in this form: written since they were read, or not stored yet. Tiles come back
/// exact to the bit, so results do not depend on eviction. Lost with the process. Thread-safe.
class TileSpill {
 public:
  virtual ~TileSpill() = default;
  /// Writes the blocks of a tile that has some. The returned source reads them, and its destructor frees their place.
  /// RESOURCE_EXHAUSTED if the disk is full; then nothing is written.
  virtual Result<std::shared_ptr<TileSource>> Write(const BlockTile& tile) = 0;
  /// Size on disk.
  [[nodiscard]] virtual std::int64_t size_bytes() const = 0;
};

}  // namespace dhpmap
