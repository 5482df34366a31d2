// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "storage/sqlite/statement.h"

struct sqlite3;

namespace dhpmap::sqlite {

enum class OpenMode {
  kReadOnly,
  kReadOnlyImmutable,  ///< for read-only files in folders where SQLite cannot create its own files
  kReadWrite,
  kReadWriteOrCreate,
};

/// A connection to a database file. Thread-compatible: one thread at a time.
class Database {
 public:
  static Result<Database> Open(const std::string& path, OpenMode mode, int busy_timeout_ms);

  static Result<Database> OpenInMemory();

  /// Runs one or more statements. `task` completes "cannot ..." in error messages.
  Status Execute(const std::string& sql, const char* task);
  Result<Statement> Prepare(const std::string& sql, const char* task);
  /// The first column of the first row.
  Result<std::int64_t> QueryInt(const std::string& sql, const char* task);

  /// For untrusted files: longer texts, blobs and rows are errors.
  void LimitLength(int max_bytes);

  /// Frees the page cache, possibly megabytes.
  void ReleaseMemory();
  /// Memory of SQLite in this process, over all connections.
  static std::int64_t BytesInUse();

  /// Whether the file cannot be written.
  [[nodiscard]] bool IsReadOnly() const;
  [[nodiscard]] bool InTransaction() const;
  /// Size of the write-ahead log's file; 0 if there is none.
  [[nodiscard]] std::int64_t NumLogBytes() const;
  [[nodiscard]] std::int64_t LastInsertRowId() const;
  /// Rows changed by the last INSERT, UPDATE or DELETE, without those of triggers.
  [[nodiscard]] std::int64_t NumChanges() const;
  /// Off: closing does not checkpoint the write-ahead log. On by default.
  void SetCheckpointOnClose(bool on);

 private:
  friend class StoppedBy;
  struct Closer {
    void operator()(sqlite3* database) const;
  };
  static Result<Database> OpenNamed(const std::string& name, int flags);
  explicit Database(sqlite3* database) : database_(database) {}
  std::unique_ptr<sqlite3, Closer> database_;
};

/// During its lifetime, the connection's statements end with CANCELLED soon after a `stop` request. One at a time for a
/// connection, which outlives it.
class StoppedBy {
 public:
  StoppedBy(Database& database, std::stop_token stop);
  ~StoppedBy();
  StoppedBy(const StoppedBy&) = delete;
  StoppedBy& operator=(const StoppedBy&) = delete;

 private:
  const std::stop_token stop_;
  sqlite3* const database_;
  const std::stop_callback<std::function<void()>> interrupt_;
};

}  // namespace dhpmap::sqlite
