// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "storage/paging/reading_gate.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// The connections that read tiles of open maps on demand. Outlives the store while such a map is in use. Thread-safe.
class PageReader {
 public:
  PageReader(ConnectionOptions options, int max_connections)
      : pool_(std::make_unique<Pool>(std::move(options), max_connections)) {}

  /// See Pool::Read. `name`: of the map, for errors. UNAVAILABLE once the store is closed.
  template <typename Value, typename Reader>
  Result<Value> With(const std::string& name, Reader&& read) {
    DHPMAP_RETURN_IF_ERROR(gate_.Enter(name));
    const ReadingGate::Visit visit(gate_);
    return pool_->Read<Value>(std::forward<Reader>(read));
  }
  /// Waits for active readers, then disconnects.
  void Close() {
    gate_.Close();
    pool_ = nullptr;
  }

 private:
  ReadingGate gate_;
  std::unique_ptr<Pool> pool_;  ///< changed only by Close, without active readers
};

}  // namespace dhpmap::postgres
