// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <compare>
#include <cstdlib>
#include <cstring>
#include <set>

#include "mapping/base/mutex.h"

namespace dhpmap {
namespace {

Status CannotOpen(int error) {
  const std::string cause = std::strerror(error);
  if (error == ENOENT) return NotFound("the folder of the database does not exist");
  return FailedPrecondition("the database is not writable: cannot lock it: " + cause).WithReason("NOT_WRITABLE");
}

/// The holder recorded in the lock file.
std::string HolderIn(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
  return size > 0 ? "process " + std::string(text.data()) : "another process";
}

Status InUse(int descriptor) {
  return FailedPrecondition("the database is in use by " + HolderIn(descriptor)).WithReason("DATABASE_IN_USE");
}

/// Resolves symbolic links, so that all names of a file share one lock file.
std::string Resolved(const std::string& database_path) {
  char* const resolved = realpath(database_path.c_str(), nullptr);
  std::string path = resolved ? resolved : database_path;
  std::free(resolved);
  return path;
}

struct FileId {
  dev_t device = 0;
  ino_t number = 0;
  auto operator<=>(const FileId&) const = default;
};
FileId IdOf(const struct stat& file) { return {file.st_dev, file.st_ino}; }

/// Whether the locked file still has this name: its last holder may have removed it, or somebody replaced it, between
/// open and lock.
bool IsStill(const std::string& path, int descriptor) {
  struct stat ours {
  }, named{};
  return fstat(descriptor, &ours) == 0 && stat(path.c_str(), &named) == 0 && IdOf(ours) == IdOf(named);
}

/// For error messages of other processes; the lock works without it.
void WriteHolder(int descriptor) {
  const std::string holder = std::to_string(getpid());
  if (ftruncate(descriptor, 0) == 0) (void)!pwrite(descriptor, holder.data(), holder.size(), 0);
}

/// The databases held by this process.
struct Held {
  Mutex mutex;
  std::set<FileId> files DHPMAP_GUARDED_BY(mutex);
};
Held& HeldHere() {
  static Held held;
  return held;
}

Status InUseHere() {
  return FailedPrecondition("the database is in use by process " + std::to_string(getpid()))
      .WithReason("DATABASE_IN_USE");
}

}  // namespace

std::string FileLock::HolderOf(const std::string& database_path) {
  const int descriptor = open((Resolved(database_path) + "-lock").c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return "";
  const bool is_held = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::string holder = is_held ? HolderIn(descriptor) : "";
  close(descriptor);
  return holder;
}

Result<FileLock> FileLock::Acquire(const std::string& database_path) {
  const std::string path = Resolved(database_path);
  FileLock lock(path + "-lock");
  DHPMAP_RETURN_IF_ERROR(lock.LockName());
  DHPMAP_RETURN_IF_ERROR(lock.LockDatabase(path));
  WriteHolder(lock.descriptor_);
  return lock;
}

Status FileLock::LockName() {
  for (;;) {
    const int descriptor = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) return CannotOpen(errno);
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      Status status = error == EWOULDBLOCK ? InUse(descriptor) : CannotOpen(error);
      close(descriptor);
      return status;
    }
    if (IsStill(path_, descriptor)) {
      descriptor_ = descriptor;
      return Status::Ok();
    }
    close(descriptor);
  }
}

Status FileLock::LockDatabase(const std::string& path) {
  // Held throughout, so that no other thread opens the file between the check and the entry.
  const MutexLock lock(HeldHere().mutex);
  for (;;) {
    struct stat named {};
    if (stat(path.c_str(), &named) == 0) {
      if (!S_ISREG(named.st_mode)) return FailedPrecondition("the database is not a file").WithReason("NOT_A_FILE");
      if (HeldHere().files.contains(IdOf(named))) return InUseHere();
    }
    const int descriptor = open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0644);
    if (descriptor < 0) return CannotOpen(errno);
    struct stat opened {};
    if (fstat(descriptor, &opened) != 0) return CannotOpen(errno);  // not closed: see above
    // The file was replaced by one that we hold: keep it open, because closing it would drop the holder's locks.
    if (HeldHere().files.contains(IdOf(opened))) return InUseHere();
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      close(descriptor);  // no store of this process has the file open
      return error == EWOULDBLOCK
                 ? FailedPrecondition("the database is in use by another process").WithReason("DATABASE_IN_USE")
                 : CannotOpen(error);
    }
    if (IsStill(path, descriptor)) {
      database_ = descriptor;
      HeldHere().files.insert(IdOf(opened));
      return Status::Ok();
    }
    close(descriptor);
  }
}

FileLock::~FileLock() {
  if (database_ >= 0) {
    const MutexLock lock(HeldHere().mutex);
    struct stat file {};
    if (fstat(database_, &file) == 0) HeldHere().files.erase(IdOf(file));
    close(database_);
  }
  if (descriptor_ < 0) return;
  unlink(path_.c_str());  // before the lock is released, so that it is certainly our file
  close(descriptor_);
}

}  // namespace dhpmap
