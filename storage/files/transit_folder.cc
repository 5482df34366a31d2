// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/transit_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr char kTransitPrefix[] = "dhpmap-transit-";

std::string ParentOr(std::string parent) {
  std::error_code error;
  if (parent.empty()) parent = fs::temp_directory_path(error).string();
  return parent.empty() ? "." : parent;
}

/// A descriptor of a folder that nobody else has locked, locked; -1 if there is none.
int LockFolder(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  if (descriptor >= 0) close(descriptor);
  return -1;
}

/// Those whose processes are gone. What cannot be removed stays.
void RemoveAbandoned(const std::string& parent) {
  std::error_code error, ignored;
  for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error)) {
    if (!it->path().filename().string().starts_with(kTransitPrefix)) continue;
    const int descriptor = LockFolder(it->path().string());
    if (descriptor < 0) continue;
    fs::remove_all(it->path(), ignored);
    close(descriptor);
  }
}

}  // namespace

TransitFolder::TransitFolder(std::string parent) : parent_(ParentOr(std::move(parent))) {}

TransitFolder::~TransitFolder() {
  const MutexLock lock(mutex_);
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  close(descriptor_);
}

Status TransitFolder::Make() {
  RemoveAbandoned(parent_);
  constexpr int kMostTries = 8;  // who removes what is abandoned may come between the making and the lock
  for (int n = 0; n < kMostTries; ++n) {
    std::string path = parent_ + "/" + kTransitPrefix + "XXXXXX";
    if (mkdtemp(path.data()) == nullptr) {
      return Unavailable(std::string("cannot make a folder for the map's file: ") + std::strerror(errno));
    }
    descriptor_ = LockFolder(path);
    std::error_code error;
    if (descriptor_ >= 0 && fs::exists(path, error)) {
      path_ = std::move(path);
      return Status::Ok();
    }
    if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  }
  return Unavailable("cannot make a folder for the map's file: others remove it");
}

Result<std::string> TransitFolder::NewPlace() {
  const MutexLock lock(mutex_);
  if (path_.empty()) DHPMAP_RETURN_IF_ERROR(Make());
  return path_ + "/map-" + std::to_string(num_places_++);
}

}  // namespace dhpmap
