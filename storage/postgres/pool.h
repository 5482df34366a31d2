// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// Up to `max_connections` connections, opened on demand, each used by one thread at a time. If all are borrowed,
/// Borrow waits. Thread-safe.
class Pool {
 public:
  Pool(ConnectionOptions options, int max_connections) : options_(std::move(options)), num_left_(max_connections) {}

  /// A borrowed connection; its destructor returns it, unless it is broken.
  class Lease {
   public:
    Lease(Pool& pool, Connection connection) : pool_(&pool), connection_(std::move(connection)) {}
    Lease(Lease&& other) noexcept
        : pool_(std::exchange(other.pool_, nullptr)), connection_(std::move(other.connection_)) {}
    Lease& operator=(Lease&&) = delete;
    ~Lease() {
      if (pool_ != nullptr) pool_->Return(std::move(connection_));
    }
    Connection& operator*() { return connection_; }
    Connection* operator->() { return &connection_; }

   private:
    Pool* pool_;
    Connection connection_;
  };
  /// `is_new`: opens a new connection, since an idle one may have been lost.
  Result<Lease> Borrow(bool is_new = false) DHPMAP_EXCLUDES(mutex_);

  /// Calls read(connection), which returns a Result. If the connection was lost, calls it once more on a new one. Only
  /// for reads.
  template <typename Value, typename Reader>
  Result<Value> Read(Reader&& read) {
    for (bool is_second = false;; is_second = true) {
      DHPMAP_ASSIGN_OR_RETURN(Lease lease, Borrow(is_second));
      Result<Value> value = read(*lease);
      if (value.ok() || is_second || !lease->IsBroken() || value.status().code() != StatusCode::kUnavailable) {
        return value;
      }
    }
  }

  /// Of all connections that are not borrowed now.
  [[nodiscard]] std::int64_t num_round_trips() DHPMAP_EXCLUDES(mutex_);

 private:
  void Return(Connection connection) DHPMAP_EXCLUDES(mutex_);

  const ConnectionOptions options_;
  Mutex mutex_;
  CondVar is_returned_;
  int num_left_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<Connection> idle_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t num_trips_of_lost_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap::postgres
