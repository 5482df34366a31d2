// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <utility>

namespace dhpmap {
namespace {

/// A file that is renamed before it is synced may be empty after a power cut.
bool Sync(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_synced = fsync(descriptor) == 0 || errno == EINVAL;  // some devices cannot be synced
  close(descriptor);
  return is_synced;
}

}  // namespace

Result<OutputFile> OutputFile::Open(const std::string& path) {
  OutputFile file(path);
  if (!file.is_stdout()) {
    file.file_.open(file.partial_path(), std::ios::binary | std::ios::trunc);
    if (!file.file_) return FailedPrecondition("cannot write " + path);
  }
  return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::exchange(other.path_, {})), file_(std::move(other.file_)), num_bytes_(other.num_bytes_) {}

OutputFile::~OutputFile() {
  if (path_.empty() || is_stdout()) return;
  file_.close();
  std::remove(partial_path().c_str());
}

void OutputFile::Write(std::string_view data) {
  (is_stdout() ? std::cout : file_).write(data.data(), static_cast<std::streamsize>(data.size()));
  num_bytes_ += static_cast<std::int64_t>(data.size());
}

Status OutputFile::Close() {
  if (is_stdout()) {
    std::cout.flush();
    return std::cout ? Status::Ok() : ResourceExhausted("cannot write to stdout");
  }
  file_.close();
  const std::string path = std::exchange(path_, {});
  if (file_ && Sync(path + ".part") && std::rename((path + ".part").c_str(), path.c_str()) == 0) return Status::Ok();
  std::remove((path + ".part").c_str());
  return ResourceExhausted("cannot write all of " + path);
}

}  // namespace dhpmap
