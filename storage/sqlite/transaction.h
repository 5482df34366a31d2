// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"

namespace dhpmap::sqlite {

/// Rolled back by its destructor unless committed. The Database must outlive it; one at a time.
class Transaction {
 public:
  /// A consistent state of the database for all reads until the end.
  static Result<Transaction> BeginRead(Database& database);
  /// Takes the write lock at once: UNAVAILABLE if another connection holds it longer than the busy timeout.
  static Result<Transaction> BeginWrite(Database& database);

  Transaction(Transaction&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();

  /// On error nothing is written.
  Status Commit();

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_;
};

}  // namespace dhpmap::sqlite
