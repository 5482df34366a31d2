// SPDX-License-Identifier: BSD-3-Clause
#include "storage/sqlite/database.h"

#include <sqlite3.h>

#include <filesystem>
#include <system_error>

#include "storage/sqlite/sqlite_error.h"

namespace dhpmap::sqlite {
namespace {

int FlagsOf(OpenMode mode) {
  switch (mode) {
    case OpenMode::kReadOnly: return SQLITE_OPEN_READONLY;
    case OpenMode::kReadOnlyImmutable: return SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
    case OpenMode::kReadWrite: return SQLITE_OPEN_READWRITE;
    case OpenMode::kReadWriteOrCreate: return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  return SQLITE_OPEN_READONLY;
}

std::string ImmutableUri(const std::string& path) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : path) {
    if (c != '%' && c != '?' && c != '#') {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
  }
  return uri + "?immutable=1";
}

/// SQLite may treat a name that starts with "file:" as a URI, and ":memory:" as no file.
std::string PlainName(const std::string& path) { return path.starts_with('/') ? path : "./" + path; }

}  // namespace

void Database::Closer::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Result<Database> Database::OpenNamed(const std::string& name, int flags) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, nullptr);
  Database database(handle);  // must be closed even if opening failed
  if (code != SQLITE_OK) return ErrorFrom(code, "open the database");
  return database;
}

Result<Database> Database::Open(const std::string& path, OpenMode mode, int busy_timeout_ms) {
  const std::string plain = PlainName(path);
  DHPMAP_ASSIGN_OR_RETURN(Database database,
                          OpenNamed(mode == OpenMode::kReadOnlyImmutable ? ImmutableUri(plain) : plain, FlagsOf(mode)));
  sqlite3_busy_timeout(database.database_.get(), busy_timeout_ms);
  return database;
}

Result<Database> Database::OpenInMemory() { return OpenNamed(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE); }

Status Database::Execute(const std::string& sql, const char* task) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  return code == SQLITE_OK ? Status::Ok() : ErrorFrom(code, task);
}

Result<Statement> Database::Prepare(const std::string& sql, const char* task) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(database_.get(), sql.c_str(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  if (code != SQLITE_OK) return ErrorOfStatement(code, task);
  return Statement(statement, task);
}

Result<std::int64_t> Database::QueryInt(const std::string& sql, const char* task) {
  DHPMAP_ASSIGN_OR_RETURN(Statement statement, Prepare(sql, task));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, statement.Step());
  if (!has_row) return Internal(std::string("cannot ") + task + ": no answer");
  return statement.Int(0);
}

void Database::ReleaseMemory() { (void)sqlite3_db_release_memory(database_.get()); }

std::int64_t Database::BytesInUse() { return sqlite3_memory_used(); }

void Database::LimitLength(int max_bytes) { sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, max_bytes); }

bool Database::IsReadOnly() const { return sqlite3_db_readonly(database_.get(), "main") != 0; }

bool Database::InTransaction() const { return sqlite3_get_autocommit(database_.get()) == 0; }

std::int64_t Database::NumLogBytes() const {
  const char* path = sqlite3_filename_wal(sqlite3_db_filename(database_.get(), "main"));
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(path == nullptr ? "" : path, none);
  return none ? 0 : static_cast<std::int64_t>(bytes);
}

std::int64_t Database::LastInsertRowId() const { return sqlite3_last_insert_rowid(database_.get()); }

std::int64_t Database::NumChanges() const { return sqlite3_changes64(database_.get()); }

void Database::SetCheckpointOnClose(bool on) {
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, on ? 0 : 1, nullptr);
}

// sqlite3_interrupt has no effect on a statement that starts a moment later, and checks of a whole file never call a
// progress handler.
StoppedBy::StoppedBy(Database& database, std::stop_token stop)
    : stop_(std::move(stop)),
      database_(database.database_.get()),
      interrupt_(stop_, [this] { sqlite3_interrupt(database_); }) {
  constexpr int kStepsBetween = 100;  // of SQLite's virtual machine, a few tens of rows
  const auto is_stopped = [](void* me) { return static_cast<const StoppedBy*>(me)->stop_.stop_requested() ? 1 : 0; };
  sqlite3_progress_handler(database_, kStepsBetween, is_stopped, this);
}

StoppedBy::~StoppedBy() { sqlite3_progress_handler(database_, 0, nullptr, nullptr); }

}  // namespace dhpmap::sqlite
