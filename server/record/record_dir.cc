// SPDX-License-Identifier: BSD-3-Clause
#include "server/record/record_dir.h"

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

Result<std::int64_t> BytesOfRecords(const std::string& path) {
  std::error_code error;
  std::int64_t num_bytes = 0;
  for (fs::directory_iterator it(path, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;  // somebody may take it away just now
    const auto size = it->path().extension() == kRecordExtension ? it->file_size(gone) : 0;
    if (!gone) num_bytes += static_cast<std::int64_t>(size);
  }
  if (error) return FailedPrecondition("cannot read the folder of records " + path + ": " + error.message());
  return num_bytes;
}

}  // namespace

Result<std::unique_ptr<RecordDir>> RecordDir::Open(const std::string& path, std::int64_t max_bytes) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return FailedPrecondition("cannot make the folder of records " + path + ": " + error.message());
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_bytes, BytesOfRecords(path));
  std::unique_ptr<RecordDir> dir(new RecordDir(path, max_bytes));
  const MutexLock lock(dir->mutex_);
  dir->num_bytes_ = num_bytes;
  return dir;
}

Result<RecordWriter> RecordDir::Begin(const std::string& map, std::int64_t now_ns) {
  const MutexLock lock(mutex_);
  DHPMAP_ASSIGN_OR_RETURN(num_bytes_, BytesOfRecords(path_));
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
