// SPDX-License-Identifier: BSD-3-Clause
#include "storage/sqlite/sqlite_error.h"

#include <sqlite3.h>

#include <string>

namespace dhpmap::sqlite {
namespace {

StatusCode CodeOfIoError(int code) {
  switch (code) {
    case SQLITE_IOERR_NOMEM: return StatusCode::kResourceExhausted;
    case SQLITE_IOERR_SHORT_READ:
    case SQLITE_IOERR_DATA:
    case SQLITE_IOERR_CORRUPTFS: return StatusCode::kDataLoss;
    default: return StatusCode::kUnavailable;
  }
}

StatusCode CodeOf(int code) {
  switch (code & 0xFF) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL: return StatusCode::kUnavailable;
    case SQLITE_FULL:
    case SQLITE_NOMEM:
    case SQLITE_TOOBIG: return StatusCode::kResourceExhausted;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB: return StatusCode::kDataLoss;
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_AUTH: return StatusCode::kFailedPrecondition;
    case SQLITE_INTERRUPT: return StatusCode::kCancelled;
    case SQLITE_IOERR: return CodeOfIoError(code);
    case SQLITE_CONSTRAINT:
      return code == SQLITE_CONSTRAINT_UNIQUE || code == SQLITE_CONSTRAINT_PRIMARYKEY ? StatusCode::kAlreadyExists
                                                                                      : StatusCode::kInternal;
    default: return StatusCode::kInternal;
  }
}

}  // namespace

Status ErrorFrom(int code, std::string_view task) {
  Status status(CodeOf(code),
                "cannot " + std::string(task) + ": " + sqlite3_errstr(code) + " (SQLite " + std::to_string(code) + ")");
  return code == SQLITE_TOOBIG ? Status(status).WithReason("BODY_TOO_LARGE") : status;
}

Status ErrorOfStatement(int code, std::string_view task) {
  if (code == SQLITE_ERROR) return DataLoss("cannot " + std::string(task) + ": a table or column is gone (SQLite 1)");
  return ErrorFrom(code, task);
}

}  // namespace dhpmap::sqlite
