// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/files/upgrade_copy.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// Opens the writing connection, creating or migrating the database, of which `copy` is kept before. `copy.progress`
/// reports long work. Errors as OpenSqliteStore.
Result<sqlite::Database> OpenWriter(const std::string& path, int busy_timeout_ms, const UpgradeCopyOptions& copy = {});

/// A connection to a writer's database for checkpoints of its log. It never waits for locks.
Result<sqlite::Database> OpenForLog(const std::string& path);

/// A pool of read-only connections, each used by one thread at a time and opened on demand. Thread-safe.
class ReaderPool {
 public:
  /// `mode` is one of the read-only ones.
  ReaderPool(std::string path, sqlite::OpenMode mode, int busy_timeout_ms)
      : path_(std::move(path)), mode_(mode), busy_timeout_ms_(busy_timeout_ms) {}

  /// A borrowed connection; its destructor returns it.
  class Lease {
   public:
    Lease(ReaderPool& pool, sqlite::Database database) : pool_(&pool), database_(std::move(database)) {}
    Lease(Lease&& other) noexcept : pool_(std::exchange(other.pool_, nullptr)), database_(std::move(other.database_)) {}
    Lease& operator=(Lease&&) = delete;
    ~Lease() {
      if (pool_ != nullptr) pool_->Return(std::move(database_));
    }
    sqlite::Database& operator*() { return database_; }

   private:
    ReaderPool* pool_;
    sqlite::Database database_;
  };
  Result<Lease> Borrow();

 private:
  void Return(sqlite::Database database);

  const std::string path_;
  const sqlite::OpenMode mode_;
  const int busy_timeout_ms_;
  Mutex mutex_;
  std::vector<sqlite::Database> idle_ DHPMAP_GUARDED_BY(mutex_);
};

/// The mode in which a database without write permission can be read: FAILED_PRECONDITION, NOT_FOUND or DATA_LOSS if it
/// cannot.
Result<sqlite::OpenMode> ProbeReadOnly(const std::string& path, int busy_timeout_ms);

}  // namespace dhpmap
