// SPDX-License-Identifier: BSD-3-Clause
#include "storage/map_import.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "storage/backup.h"
#include "storage/map_file.h"

namespace dhpmap {
namespace {

Status CannotKeep(int error) {
  const bool is_full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return {is_full ? StatusCode::kResourceExhausted : StatusCode::kUnavailable,
          std::string("cannot keep the file: ") + std::strerror(error)};
}

class FileImport final : public MapImport {
 public:
  /// Takes the descriptor over, and the file.
  FileImport(std::string path, int descriptor, WriteDurably write)
      : path_(std::move(path)), descriptor_(descriptor), write_(std::move(write)) {}
  ~FileImport() override {
    Close();
    RemoveDatabase(path_);
  }
  FileImport(const FileImport&) = delete;
  FileImport& operator=(const FileImport&) = delete;

  Status Write(std::string_view piece) override {
    while (!piece.empty()) {
      const ssize_t num_written = write(descriptor_, piece.data(), piece.size());
      if (num_written < 0 && errno == EINTR) continue;
      if (num_written < 0) return CannotKeep(errno);
      piece.remove_prefix(static_cast<std::size_t>(num_written));
    }
    return Status::Ok();
  }

  Result<std::string> Finish(const std::string& name, const std::stop_token& stop) override {
    Close();  // before SQLite has locks on it
    DHPMAP_ASSIGN_OR_RETURN(MapFile file, MapFile::Open(path_, stop));
    std::string new_name = name.empty() ? file.map_name() : name;
    DHPMAP_RETURN_IF_ERROR(ValidateMapName(new_name));
    DHPMAP_RETURN_IF_ERROR(write_([&](sqlite::Database& database) { return file.CopyInto(database, new_name, stop); }));
    return new_name;
  }

 private:
  void Close() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
  }

  const std::string path_;
  int descriptor_;
  const WriteDurably write_;
};

}  // namespace

Result<std::unique_ptr<MapImport>> BeginMapImport(const std::string& path, WriteDurably write) {
  std::string place = UnfinishedPath(path);
  const int descriptor = open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return CannotKeep(errno);
  return std::unique_ptr<MapImport>(std::make_unique<FileImport>(std::move(place), descriptor, std::move(write)));
}

}  // namespace dhpmap
