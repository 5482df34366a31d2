// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/backup.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include "storage/rows/map_rows.h"
#include "storage/sqlite/free_pages.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUnfinishedSuffix = "-backup-";

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

Status CheckPlace(const std::string& path) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(path, error))) {
    return AlreadyExists("there is a file already where the backup is to be written").WithReason("BACKUP_EXISTS");
  }
  const fs::path folder = fs::path(path).parent_path();
  if (folder.empty() || fs::is_directory(folder, error)) return Status::Ok();
  return InvalidArgument("there is no folder where the backup is to be written").WithReason("BAD_BACKUP_PATH");
}

Status MarkFile(const std::string& path) {
  constexpr int kBusyTimeout_ms = 0;  // no other connection knows the file
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Database copy,
                          sqlite::Database::Open(path, sqlite::OpenMode::kReadWrite, kBusyTimeout_ms));
  return MarkAsBackup(copy);
}

/// Allows the copy to return free space, even if the original cannot.
Status AllowCopyGivingBack(sqlite::Database& original) {
  DHPMAP_ASSIGN_OR_RETURN(const bool is_allowed, sqlite::AllowsGivingBack(original));
  return is_allowed ? Status::Ok() : sqlite::AllowGivingBack(original);  // affects only the output of VACUUM
}

/// Limits the connection's cache, so that VACUUM writes the copy gradually. With the normal cache a file of a few
/// megabytes is written at the very end, which cannot be interrupted.
class SmallCache {
 public:
  static Result<SmallCache> For(sqlite::Database& database) {
    constexpr char kTask[] = "see how much is cached";
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t before, database.QueryInt("PRAGMA cache_size", kTask));
    DHPMAP_RETURN_IF_ERROR(database.Execute("PRAGMA cache_size = -1024", kTask));
    return SmallCache(database, before);
  }
  SmallCache(SmallCache&& other) noexcept
      : database_(std::exchange(other.database_, nullptr)), before_(other.before_) {}
  SmallCache& operator=(SmallCache&&) = delete;
  ~SmallCache() {
    if (database_ == nullptr) return;
    (void)database_->Execute("PRAGMA cache_size = " + std::to_string(before_), "cache as much as before");
  }

 private:
  SmallCache(sqlite::Database& database, std::int64_t before) : database_(&database), before_(before) {}
  sqlite::Database* database_;
  std::int64_t before_;
};

/// A file that only this object knows.
class OpenBackup final : public StoreBackup {
 public:
  /// Takes ownership of the descriptor.
  OpenBackup(int descriptor, std::int64_t size_bytes) : descriptor_(descriptor), size_bytes_(size_bytes) {}
  ~OpenBackup() override { close(descriptor_); }
  OpenBackup(const OpenBackup&) = delete;
  OpenBackup& operator=(const OpenBackup&) = delete;

  [[nodiscard]] std::int64_t size_bytes() const override { return size_bytes_; }

  Result<std::string> Read(std::size_t max_bytes) override {
    std::string data(max_bytes, '\0');
    ssize_t num_read = -1;
    do {
      num_read = read(descriptor_, data.data(), data.size());
    } while (num_read < 0 && errno == EINTR);
    if (num_read < 0) return Unavailable(std::string("cannot read the backup: ") + std::strerror(errno));
    data.resize(static_cast<std::size_t>(num_read));
    return data;
  }

 private:
  const int descriptor_;
  const std::int64_t size_bytes_;
};

}  // namespace

Status CopyInto(sqlite::Database& database, const std::string& path) {
  return database.Execute("VACUUM INTO " + Quoted(path), "write the backup");
}

Status WriteBackup(sqlite::Database& database, const std::string& path, const std::stop_token& stop) {
  DHPMAP_RETURN_IF_ERROR(CheckPlace(path));
  DHPMAP_RETURN_IF_ERROR(AllowCopyGivingBack(database));
  DHPMAP_ASSIGN_OR_RETURN(const SmallCache small_cache, SmallCache::For(database));
  Status status;
  {
    const sqlite::StoppedBy stopped(database, stop);
    status = CopyInto(database, path);
  }
  if (status.ok()) status = MarkFile(path);
  if (status.ok() && stop.stop_requested()) status = Cancelled("the backup is not wanted any more");
  std::error_code ignored;
  if (!status.ok()) fs::remove(path, ignored);
  return status;
}

std::string UnfinishedPath(const std::string& path) {
  static std::atomic<int> number = 0;
  return path + std::string(kUnfinishedSuffix) + std::to_string(number++);
}

Result<std::unique_ptr<StoreBackup>> MakeBackup(sqlite::Database& database, const std::string& path,
                                                const std::stop_token& stop) {
  const std::string place = UnfinishedPath(path);
  DHPMAP_RETURN_IF_ERROR(WriteBackup(database, place, stop));
  return OpenOnce(place);
}

Result<std::unique_ptr<StoreBackup>> OpenOnce(const std::string& place) {
  const int descriptor = open(place.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat attributes {};
  const bool is_open = descriptor >= 0 && fstat(descriptor, &attributes) == 0;
  const int error = errno;
  unlink(place.c_str());
  if (!is_open) {
    if (descriptor >= 0) close(descriptor);
    return Unavailable(std::string("cannot open the backup: ") + std::strerror(error));
  }
  return std::unique_ptr<StoreBackup>(std::make_unique<OpenBackup>(descriptor, attributes.st_size));
}

void RemoveUnfinishedBackups(const std::string& path) {
  const fs::path file(path);
  const std::string prefix = file.filename().string() + std::string(kUnfinishedSuffix);
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().filename().string().starts_with(prefix)) {
      std::error_code ignored;
      fs::remove(it->path(), ignored);
    }
  }
}

}  // namespace dhpmap
