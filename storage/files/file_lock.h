// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "mapping/base/result.h"

namespace dhpmap {

/// The right of one store at a time, in any process, to write a database. Held as two locks of the operating system, so
/// it ends with its process, however that ends: one on the database file, which holds whatever name it is opened by,
/// and one on "<database>-lock", where a holder leaves its process id for the message to the next one.
///
/// Closing any descriptor of the database drops the locks that SQLite has on it in this process. So the lock must
/// outlive all connections of its store, and a file that is locked in this process is never opened a second time.
/// Movable; released at the end of life.
class FileLock {
 public:
  /// Makes an empty file if there is none. FAILED_PRECONDITION, by reason: DATABASE_IN_USE, naming the process where it
  /// is known, if another store holds it; NOT_WRITABLE if the lock file cannot be written; NOT_A_FILE. NOT_FOUND if its
  /// folder is not there.
  static Result<FileLock> Acquire(const std::string& database_path);

  FileLock(FileLock&& other) noexcept
      : path_(std::move(other.path_)),
        descriptor_(std::exchange(other.descriptor_, -1)),
        database_(std::exchange(other.database_, -1)) {}
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(std::string path) : path_(std::move(path)) {}
  Status LockName();
  Status LockDatabase(const std::string& path);

  std::string path_;     // of the lock file
  int descriptor_ = -1;  // of the lock file
  int database_ = -1;
};

}  // namespace dhpmap
