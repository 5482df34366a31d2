// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/base/result.h"
#include "mapping/paging/tile_page.h"
#include "mapping/voxels/block_tile.h"

namespace dhpmap {

/// Where tiles are left whose blocks no store has as they are in memory: written since they were read, or not stored
/// yet. What comes back is the same to the bit, so that it does not depend on what was left when. Of the process: it is
/// lost with it. Thread-safe.
class TileSpill {
 public:
  virtual ~TileSpill() = default;
  /// Writes the blocks of a tile, of which there are some. What is returned reads them, and gives their place back at
  /// the end of its life. RESOURCE_EXHAUSTED if the disk is full; nothing is written then.
  virtual Result<std::shared_ptr<TileSource>> Write(const BlockTile& tile) = 0;
  /// On the disk.
  [[nodiscard]] virtual std::int64_t size_bytes() const = 0;
};

}  // namespace dhpmap
