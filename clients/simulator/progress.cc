// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace dhpmap::simulator {

Progress::Progress(int total, bool is_quiet)
    : total_(total), is_quiet_(is_quiet), is_terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::Step() {
  const MutexLock lock(mutex_);
  ++done_;
  if (!is_quiet_) Draw();
}

void Progress::Draw() {
  const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (is_terminal_) {
    constexpr int kWidth = 30;
    const int filled = kWidth * done_ / total_;
    const std::string bar = std::string(static_cast<std::size_t>(filled), '=') +
                            std::string(static_cast<std::size_t>(kWidth - filled), ' ');
    std::fprintf(stderr, "\r[%s] %d/%d frames, %.0f s left \x1b[K%s", bar.c_str(), done_, total_,
                 spent_s / done_ * (total_ - done_), done_ == total_ ? "\n" : "");
    std::fflush(stderr);
  } else if (4 * done_ / total_ != 4 * (done_ - 1) / total_) {
    std::fprintf(stderr, "%d/%d frames in %.1f s\n", done_, total_, spent_s);
  }
}

}  // namespace dhpmap::simulator
