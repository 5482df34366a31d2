// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/map_import.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace dhpmap {
namespace {

Status CannotKeep(int error) {
  const bool is_full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return {is_full ? StatusCode::kResourceExhausted : StatusCode::kUnavailable,
          std::string("cannot keep the file: ") + std::strerror(error)};
}

/// Disk space to leave for commits of all maps during an import.
constexpr std::uint64_t kLeftFree_bytes = 256u << 20;
/// Between checks of the free space.
constexpr std::uint64_t kLookEvery_bytes = 8u << 20;

/// Whether the disk has space for the file's blobs, which are copied once more.
Status CheckRoomForFile(int descriptor, std::uint64_t file_bytes) {
  struct statvfs disk {};
  if (fstatvfs(descriptor, &disk) != 0) return Status::Ok();  // then writing reports it
  const std::uint64_t free_bytes = std::uint64_t{disk.f_bavail} * disk.f_frsize;
  if (free_bytes >= file_bytes + kLeftFree_bytes) return Status::Ok();
  return ResourceExhausted("the file would leave too little of the disk: it takes twice its size, and " +
                           std::to_string(kLeftFree_bytes >> 20) + " MiB stay free");
}

class FileImport final : public MapImport {
 public:
  /// Takes the descriptor over, and the file.
  FileImport(std::string path, int descriptor, MakeTaker make_taker)
      : path_(std::move(path)), descriptor_(descriptor), make_taker_(std::move(make_taker)) {}
  ~FileImport() override {
    Close();
    taker_.reset();
    RemoveDatabase(path_);
  }
  FileImport(const FileImport&) = delete;
  FileImport& operator=(const FileImport&) = delete;

  Status Write(std::string_view piece) override {
    if (num_bytes_ >= next_look_bytes_) {
      DHPMAP_RETURN_IF_ERROR(CheckRoomForFile(descriptor_, num_bytes_ + kLookEvery_bytes));
      next_look_bytes_ = num_bytes_ + kLookEvery_bytes;
    }
    num_bytes_ += piece.size();
    while (!piece.empty()) {
      const ssize_t num_written = write(descriptor_, piece.data(), piece.size());
      if (num_written < 0 && errno == EINTR) continue;
      if (num_written < 0) return CannotKeep(errno);
      piece.remove_prefix(static_cast<std::size_t>(num_written));
    }
    return Status::Ok();
  }

  Result<std::string> LookThrough(const std::stop_token& stop) override {
    Close();  // before SQLite locks it
    DHPMAP_ASSIGN_OR_RETURN(MapFile file, MapFile::Open(path_, stop));
    std::string name = file.map_name();
    taker_ = make_taker_(std::move(file));
    return name;
  }

  Status Bring(const std::stop_token& stop) override { return taker_->Bring(stop); }

  Status Add(const std::string& name) override {
    DHPMAP_RETURN_IF_ERROR(ValidateMapName(name));
    return taker_->Add(name);
  }

 private:
  void Close() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
  }

  const std::string path_;
  int descriptor_;
  std::uint64_t num_bytes_ = 0, next_look_bytes_ = 0;
  const MakeTaker make_taker_;
  std::unique_ptr<MapTaker> taker_;  ///< once the file is looked through
};

}  // namespace

Result<std::unique_ptr<MapImport>> BeginMapImport(std::string place, MakeTaker make_taker) {
  const int descriptor = open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return CannotKeep(errno);
  return std::unique_ptr<MapImport>(std::make_unique<FileImport>(std::move(place), descriptor, std::move(make_taker)));
}

}  // namespace dhpmap
