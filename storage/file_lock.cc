// SPDX-License-Identifier: BSD-3-Clause
#include "storage/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace dhpmap {
namespace {

Status CannotOpen(int error) {
  const std::string cause = std::strerror(error);
  if (error == ENOENT) return NotFound("the folder of the database does not exist");
  return FailedPrecondition("the database is not writable: cannot lock it: " + cause).WithReason("NOT_WRITABLE");
}

Status InUse(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
  const std::string holder = size > 0 ? "process " + std::string(text.data()) : "another process";
  return FailedPrecondition("the database is in use by " + holder).WithReason("DATABASE_IN_USE");
}

/// Whether the locked file is still the one of that name: its last holder may have removed it between our open and
/// lock.
bool IsStill(const std::string& path, int descriptor) {
  struct stat ours {
  }, named{};
  return fstat(descriptor, &ours) == 0 && stat(path.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
         ours.st_dev == named.st_dev;
}

/// For the message to the next one; the lock holds without it.
void WriteHolder(int descriptor) {
  const std::string holder = std::to_string(getpid());
  if (ftruncate(descriptor, 0) == 0) (void)!pwrite(descriptor, holder.data(), holder.size(), 0);
}

}  // namespace

Result<FileLock> FileLock::Acquire(const std::string& database_path) {
  // Of the file itself, so that two names of one file by symbolic links are one lock.
  char* const resolved = realpath(database_path.c_str(), nullptr);
  const std::string path = (resolved ? resolved : database_path) + std::string("-lock");
  std::free(resolved);
  for (;;) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) return CannotOpen(errno);
    FileLock lock(path, -1);
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      Status status = error == EWOULDBLOCK ? InUse(descriptor) : CannotOpen(error);
      close(descriptor);
      return status;
    }
    lock.descriptor_ = descriptor;
    if (IsStill(path, descriptor)) {
      WriteHolder(descriptor);
      return lock;
    }
    close(std::exchange(lock.descriptor_, -1));
  }
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  unlink(path_.c_str());  // before the lock ends, so that nobody's lock but ours can be on it
  close(descriptor_);
}

}  // namespace dhpmap
