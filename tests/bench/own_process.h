// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "mapping/base/result.h"

namespace dhpmap::bench {

/// Runs `work` in a process of its own, so that what it leaves in memory is nobody else's, and gives what it gave:
/// text. INTERNAL if that process dies. The caller has no other thread.
Result<std::string> InOwnProcess(const std::function<Result<std::string>()>& work);

/// What this process has in memory that is no file's. 0 where the system does not tell.
std::int64_t AnonymousBytes();
/// What the system could still give. 0 where it does not tell.
std::int64_t AvailableBytes();

/// The most that this process has of it, looked at every 2 ms. Thread-safe.
class AnonymousPeak {
 public:
  AnonymousPeak();
  ~AnonymousPeak();
  AnonymousPeak(const AnonymousPeak&) = delete;
  AnonymousPeak& operator=(const AnonymousPeak&) = delete;
  [[nodiscard]] std::int64_t bytes() const { return peak_bytes_; }

 private:
  std::atomic<std::int64_t> peak_bytes_ = 0;
  std::atomic<bool> is_over_ = false;
  std::thread looker_;
};

}  // namespace dhpmap::bench
