// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "mapping/base/result.h"

namespace dhpmap {

/// Exclusive right of one store, over all processes, to write a database. Consists of two locks of the operating
/// system, which end with the process: one on the database file, under any of its names, and one on "<database>-lock",
/// which holds the process id for the message to others.
///
/// Closing any descriptor of the database drops SQLite's own locks on it in this process. So this lock must outlive all
/// connections of its store, and a file that is locked in this process is never opened a second time. Movable; the
/// destructor releases it.
class FileLock {
 public:
  /// Who holds it: "process 123", or "another process" if that is not known; empty: nobody. Changes nothing.
  static std::string HolderOf(const std::string& database_path);

  /// Creates an empty file if there is none. FAILED_PRECONDITION, by reason: DATABASE_IN_USE, naming the process if
  /// known, if another store holds it; NOT_WRITABLE if the lock file cannot be written; NOT_A_FILE. NOT_FOUND if its
  /// folder does not exist.
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
