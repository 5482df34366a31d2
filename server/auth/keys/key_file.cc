// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

namespace dhpmap::auth {
namespace {

constexpr std::size_t kMostFileBytes = 16u << 20;

Status BadFile(const std::string& path, const std::string& why) {
  return FailedPrecondition("the file of keys " + path + " " + why).WithReason("BAD_KEY_FILE");
}
Status SystemFault(const std::string& path, const char* what) {
  return BadFile(path, std::string(what) + ": " + std::strerror(errno));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  const int fd_;
};

FileState StateOf(const struct stat& status) {
  return {.device = status.st_dev,
          .inode = status.st_ino,
          .size = static_cast<std::uint64_t>(status.st_size),
          .changed_ns = status.st_ctim.tv_sec * std::int64_t{1'000'000'000} + status.st_ctim.tv_nsec};
}

Status CheckKind(const std::string& path, const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return BadFile(path, "is no plain file");
  if (status.st_uid != geteuid() && status.st_uid != 0) return BadFile(path, "is of another user");
  if ((status.st_mode & 077) != 0) return BadFile(path, "is open to others than its owner: chmod 600 it");
  if (static_cast<std::size_t>(status.st_size) > kMostFileBytes) return BadFile(path, "is larger than 16 MiB");
  return Status::Ok();
}

Status ReadAll(const std::string& path, int fd, std::string& text) {
  for (std::size_t size = 0;;) {
    text.resize(size + (64u << 10));
    const ssize_t got = read(fd, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return SystemFault(path, "cannot be read");
    size += static_cast<std::size_t>(got);
    text.resize(size);
    if (got == 0) return Status::Ok();
    if (size > kMostFileBytes) return BadFile(path, "is larger than 16 MiB");
  }
}

Result<std::vector<KeyRecord>> RecordsOf(const std::string& path, std::string_view text) {
  std::vector<KeyRecord> records;
  std::set<std::string, std::less<>> ids;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty()) continue;
    auto record = RecordFromLine(line);
    const std::string where = "is not usable, line " + std::to_string(number) + ": ";
    if (!record.ok()) return BadFile(path, where + record.status().message());
    if (!ids.insert(record->id).second) return BadFile(path, where + "an earlier line has the same id");
    if (records.size() == kMostKeys) return BadFile(path, "has more than " + std::to_string(kMostKeys) + " keys");
    records.push_back(*std::move(record));
  }
  return records;
}

Status WriteAll(const std::string& path, int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = write(fd, text.data(), text.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return SystemFault(path, "cannot be written");
    text.remove_prefix(static_cast<std::size_t>(put));
  }
  return fsync(fd) == 0 ? Status::Ok() : SystemFault(path, "cannot be written");
}

std::string FolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// Under the lock, so that no other process writes the same temporary file. Replaces what a crash left of one.
Status Replace(const std::string& path, const std::string& text) {
  const std::string made = path + ".new";
  unlink(made.c_str());
  {
    const Descriptor file(open(made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (file.get() < 0) return SystemFault(made, "cannot be made");
    DHPMAP_RETURN_IF_ERROR(WriteAll(made, file.get(), text));
  }
  if (rename(made.c_str(), path.c_str()) != 0) return SystemFault(path, "cannot be replaced");
  const Descriptor folder(open(FolderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return folder.get() >= 0 && fsync(folder.get()) == 0 ? Status::Ok() : SystemFault(path, "cannot be synced");
}

bool IsThere(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0 || errno != ENOENT;
}

}  // namespace

Result<PrivateFile> ReadPrivateFile(const std::string& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.get() < 0 && errno == ELOOP) return BadFile(path, "is a symbolic link");
  if (file.get() < 0) return SystemFault(path, "cannot be opened");
  struct stat status {};
  if (fstat(file.get(), &status) != 0) return SystemFault(path, "cannot be looked at");
  DHPMAP_RETURN_IF_ERROR(CheckKind(path, status));
  PrivateFile content{.text = {}, .state = StateOf(status)};
  DHPMAP_RETURN_IF_ERROR(ReadAll(path, file.get(), content.text));
  return content;
}

Result<KeyFileContent> ReadKeyFile(const std::string& path) {
  DHPMAP_ASSIGN_OR_RETURN(const PrivateFile file, ReadPrivateFile(path));
  DHPMAP_ASSIGN_OR_RETURN(auto records, RecordsOf(path, file.text));
  return KeyFileContent{.records = std::move(records), .state = file.state};
}

Result<FileState> StateOfKeyFile(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return SystemFault(path, "cannot be looked at");
  return StateOf(status);
}

Status ChangeKeyFile(const std::string& path, const std::function<Status(std::vector<KeyRecord>&)>& change) {
  const std::string lock_path = path + ".lock";
  const Descriptor lock(open(lock_path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (lock.get() < 0) return SystemFault(lock_path, "cannot be opened");
  while (flock(lock.get(), LOCK_EX) != 0) {
    if (errno != EINTR) return SystemFault(lock_path, "cannot be locked");
  }
  std::vector<KeyRecord> records;
  if (IsThere(path)) {
    DHPMAP_ASSIGN_OR_RETURN(KeyFileContent content, ReadKeyFile(path));
    records = std::move(content.records);
  }
  DHPMAP_RETURN_IF_ERROR(change(records));
  std::string text;
  for (const KeyRecord& record : records) text += LineOf(record) + "\n";
  return Replace(path, text);
}

}  // namespace dhpmap::auth
