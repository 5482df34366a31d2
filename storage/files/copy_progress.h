// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// While it is there, tells every half minute how large a file has become, if it has grown: a copy of a large database
/// takes longer than whoever waits for the server's start may have the patience for.
class CopyProgress {
 public:
  /// `tell` runs on a thread of its own; may be empty.
  CopyProgress(std::string file, std::function<void(const std::string& message)> tell);
  ~CopyProgress();
  CopyProgress(const CopyProgress&) = delete;
  CopyProgress& operator=(const CopyProgress&) = delete;

 private:
  void Run() DHPMAP_EXCLUDES(mutex_);

  const std::string file_;
  const std::function<void(const std::string&)> tell_;
  Mutex mutex_;
  CondVar changed_;
  bool is_done_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace dhpmap
