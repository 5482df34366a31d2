// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "proto/types/record_file.h"

namespace dhpmap {

/// The folder of a server's records, and how much of it they may take. Thread-safe.
class RecordDir {
 public:
  /// Makes the folder if it is not there.
  static Result<std::unique_ptr<RecordDir>> Open(const std::string& path, std::int64_t max_bytes);

  /// A new file for what comes to a map. Counts anew what is in the folder: somebody may have taken away old records.
  /// RESOURCE_EXHAUSTED, and no file, if that is full or has 10,000 records.
  Result<RecordWriter> Begin(const std::string& map, std::int64_t now_ns) DHPMAP_EXCLUDES(mutex_);
  /// False, and nothing is taken, if that would be more than there may be.
  bool Take(std::size_t num_bytes) DHPMAP_EXCLUDES(mutex_);

  /// Of all records, as far as is known.
  [[nodiscard]] std::int64_t num_bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  RecordDir(std::string path, std::int64_t max_bytes) : path_(std::move(path)), max_bytes_(max_bytes) {}

  const std::string path_;
  const std::int64_t max_bytes_;
  mutable Mutex mutex_;
  std::int64_t num_bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap
