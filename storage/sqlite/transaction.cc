// SPDX-License-Identifier: BSD-3-Clause
#include "storage/sqlite/transaction.h"

namespace dhpmap::sqlite {

Result<Transaction> Transaction::BeginRead(Database& database) {
  DHPMAP_RETURN_IF_ERROR(database.Execute("BEGIN DEFERRED", "start reading"));
  return Transaction(database);
}

Result<Transaction> Transaction::BeginWrite(Database& database) {
  DHPMAP_RETURN_IF_ERROR(database.Execute("BEGIN IMMEDIATE", "start writing"));
  return Transaction(database);
}

Transaction::~Transaction() {
  // SQLite may have rolled back already, for example on a full disk. If the rollback fails, the transaction was not
  // committed either: nothing to report.
  if (database_ != nullptr && database_->InTransaction()) (void)database_->Execute("ROLLBACK", "undo a transaction");
}

Status Transaction::Commit() {
  DHPMAP_RETURN_IF_ERROR(database_->Execute("COMMIT", "commit"));
  database_ = nullptr;
  return Status::Ok();
}

}  // namespace dhpmap::sqlite
