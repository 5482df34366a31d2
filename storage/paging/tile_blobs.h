// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mapping/paging/tile_page.h"
#include "storage/connection.h"
#include "storage/paging/reading_gate.h"
#include "storage/paging/tile_expiry.h"

namespace dhpmap {

/// Reads evicted tiles of open maps. Outlives the store as long as such a map is in use. Thread-safe.
class TileBlobs {
 public:
  /// As ReaderPool.
  TileBlobs(std::string path, sqlite::OpenMode mode, int busy_timeout_ms)
      : readers_(std::make_unique<ReaderPool>(std::move(path), mode, busy_timeout_ms)) {}

  /// The blocks of a tile, by ascending cell. Errors as TileSource, and of SQLite. `name`, of the owner, is for
  /// messages.
  Result<std::vector<BlockEntry>> Read(const std::string& name, const TileOwner& owner, const TileOnDisk& tile);

  /// Calls read(database) with a connection; it returns a Result. UNAVAILABLE once the store is closed, and errors of
  /// SQLite.
  template <typename Value, typename Reader>
  Result<Value> With(const std::string& name, Reader&& read) {
    DHPMAP_RETURN_IF_ERROR(gate_.Enter(name));
    const ReadingGate::Visit visit(gate_);  // also if memory runs out
    DHPMAP_ASSIGN_OR_RETURN(ReaderPool::Lease lease, readers_->Borrow());
    return read(*lease);
  }

  /// Waits for active readers, then closes the file.
  void Close() {
    gate_.Close();
    readers_ = nullptr;
  }

 private:
  ReadingGate gate_;
  std::unique_ptr<ReaderPool> readers_;  ///< changed only by Close, without active readers
};

}  // namespace dhpmap
