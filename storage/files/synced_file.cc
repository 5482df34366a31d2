// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/synced_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace dhpmap {
namespace {

Status Sync(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  const bool is_synced = descriptor >= 0 && fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (is_synced) return Status::Ok();
  return Unavailable(std::string("cannot bring a copy of the database to the disk: ") + std::strerror(error));
}

}  // namespace

Status SyncFile(const std::string& path) { return Sync(path, 0); }

Status MoveSynced(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) {
    return Unavailable(std::string("cannot give a copy of the database its name: ") + std::strerror(errno));
  }
  const std::string folder = std::filesystem::path(to).parent_path().string();
  return Sync(folder.empty() ? "." : folder, O_DIRECTORY);
}

}  // namespace dhpmap
