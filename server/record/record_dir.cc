// SPDX-License-Identifier: BSD-3-Clause
#include "server/record/record_dir.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// Limits inodes and the time of scanning.
constexpr std::int64_t kMostRecords = 10'000;

struct RecordTotals {
  std::int64_t num_files = 0;
  std::int64_t num_bytes = 0;
};

Result<RecordTotals> CountRecords(const std::string& path) {
  std::error_code error;
  RecordTotals totals;
  for (fs::directory_iterator it(path, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != kRecordExtension) continue;
    std::error_code gone;  // the file may be deleted concurrently
    const auto size = it->file_size(gone);
    if (gone) continue;
    ++totals.num_files;
    totals.num_bytes += static_cast<std::int64_t>(size);
  }
  if (error) return FailedPrecondition("cannot read the folder of records " + path + ": " + error.message());
  return totals;
}

}  // namespace

Result<std::unique_ptr<RecordDir>> RecordDir::Open(const std::string& path, std::int64_t max_bytes) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return FailedPrecondition("cannot make the folder of records " + path + ": " + error.message());
  DHPMAP_ASSIGN_OR_RETURN(const RecordTotals totals, CountRecords(path));
  std::unique_ptr<RecordDir> dir(new RecordDir(path, max_bytes));
  const MutexLock lock(dir->mutex_);
  dir->num_bytes_ = totals.num_bytes;
  return dir;
}

Result<RecordWriter> RecordDir::Begin(const std::string& map, std::int64_t now_ns) {
  // Without the lock, which every frame of every map takes. Bytes written meanwhile are counted by the next scan.
  DHPMAP_ASSIGN_OR_RETURN(const RecordTotals totals, CountRecords(path_));
  {
    const MutexLock lock(mutex_);
    num_bytes_ = totals.num_bytes;
  }
  if (totals.num_bytes >= max_bytes_) return ResourceExhausted("the folder of records is full");
  if (totals.num_files >= kMostRecords) {
    return ResourceExhausted("the folder has " + std::to_string(totals.num_files) + " records already");
  }
  return RecordWriter::Create((fs::path(path_) / (map + "-" + std::to_string(now_ns) + kRecordExtension)).string());
}

bool RecordDir::Take(std::size_t num_bytes) {
  const MutexLock lock(mutex_);
  const auto added = static_cast<std::int64_t>(num_bytes);
  if (added > max_bytes_ - num_bytes_) return false;
  num_bytes_ += added;
  return true;
}

std::int64_t RecordDir::num_bytes() const {
  const MutexLock lock(mutex_);
  return num_bytes_;
}

}  // namespace dhpmap
