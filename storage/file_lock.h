// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "mapping/base/result.h"

namespace dhpmap {

/// The right of one store at a time, in any process, to write a database. Held as a lock of the operating system on
/// "<database>-lock", so it ends with its process, however that ends. (Not on the database itself: closing another
/// descriptor of that file would drop SQLite's own locks.) Movable; released at the end of life.
class FileLock {
 public:
  /// FAILED_PRECONDITION, reason DATABASE_IN_USE, naming the process, if another store holds it; FAILED_PRECONDITION if
  /// the lock file cannot be written; NOT_FOUND if its folder is not there.
  static Result<FileLock> Acquire(const std::string& database_path);

  FileLock(FileLock&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  FileLock(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  std::string path_;
  int descriptor_;
};

}  // namespace dhpmap
