// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "clients/command_line/terminal_line.h"
#include "mapping/base/mutex.h"

namespace dhpmap::simulator {

/// Shows the number of frames on stderr: a bar on a terminal, else a line at each quarter. Thread-safe.
class Progress {
 public:
  Progress(int total, bool is_quiet);
  void Step();

 private:
  void Draw() DHPMAP_REQUIRES(mutex_);

  const int total_;
  const bool is_quiet_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Mutex mutex_;
  TerminalLine line_ DHPMAP_GUARDED_BY(mutex_);
  int done_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap::simulator
