// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/copy_progress.h"

#include <chrono>
#include <filesystem>
#include <utility>

namespace dhpmap {

CopyProgress::CopyProgress(std::string file, std::function<void(const std::string&)> tell)
    : file_(std::move(file)), tell_(std::move(tell)) {
  if (tell_) thread_ = std::thread([this] { Run(); });
}

CopyProgress::~CopyProgress() {
  {
    const MutexLock lock(mutex_);
    is_done_ = true;
    changed_.NotifyAll();
  }
  if (thread_.joinable()) thread_.join();
}

void CopyProgress::Run() {
  constexpr std::chrono::seconds kPeriod{30};
  std::uintmax_t told_bytes = 0;
  MutexLock lock(mutex_);
  while (!changed_.WaitFor(mutex_, kPeriod, [this]() DHPMAP_REQUIRES(mutex_) { return is_done_; })) {
    std::error_code error;
    const std::uintmax_t size_bytes = std::filesystem::file_size(file_, error);
    if (error || size_bytes <= told_bytes) continue;
    told_bytes = size_bytes;
    lock.Unlock();
    tell_("keeping a copy of the database: " + std::to_string(size_bytes >> 20) + " MiB are written");
    lock.Lock();
  }
}

}  // namespace dhpmap
