// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/schema/migrate.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// Opens the connection that writes, creating or migrating the database. `progress` hears of what takes long.
/// Errors as OpenSqliteStore.
Result<sqlite::Database> OpenWriter(const std::string& path, int busy_timeout_ms, const SchemaProgress& progress = {});

/// A connection to the database of a writer, to copy its log into the file. It never waits for others.
Result<sqlite::Database> OpenForLog(const std::string& path);

/// Connections that only read, each in use by one thread at a time, opened as they are needed. Thread-safe.
class ReaderPool {
 public:
  /// `mode` is one of the read-only ones.
  ReaderPool(std::string path, sqlite::OpenMode mode, int busy_timeout_ms)
      : path_(std::move(path)), mode_(mode), busy_timeout_ms_(busy_timeout_ms) {}

  /// A connection on loan: goes back to the pool at the end of life.
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

/// How a database that we may not write can be read: FAILED_PRECONDITION, NOT_FOUND or DATA_LOSS if it cannot.
Result<sqlite::OpenMode> ProbeReadOnly(const std::string& path, int busy_timeout_ms);

}  // namespace dhpmap
