// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "proto/types/record_file.h"

namespace dhpmap {

/// The folder of a server's recordings, and its size limit. Thread-safe.
class RecordDir {
 public:
  /// Creates the folder if necessary.
  static Result<std::unique_ptr<RecordDir>> Open(const std::string& path, std::int64_t max_bytes);

  /// Creates a file for the input of a map. Rescans the folder first, because recordings may have been deleted.
  /// RESOURCE_EXHAUSTED, without a file, if it is full or has 10,000 recordings.
  Result<RecordWriter> Begin(const std::string& map, std::int64_t now_ns) DHPMAP_EXCLUDES(mutex_);
  /// Reserves bytes. False, without effect, if that would exceed the limit.
  bool Take(std::size_t num_bytes) DHPMAP_EXCLUDES(mutex_);

  /// Size of all recordings at the last scan, plus bytes reserved since.
  [[nodiscard]] std::int64_t num_bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  RecordDir(std::string path, std::int64_t max_bytes) : path_(std::move(path)), max_bytes_(max_bytes) {}

  const std::string path_;
  const std::int64_t max_bytes_;
  mutable Mutex mutex_;
  std::int64_t num_bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap
