// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/progress.h"

#include <cstdio>
#include <string>

namespace dhpmap::simulator {

Progress::Progress(int total, bool is_quiet) : total_(total), is_quiet_(is_quiet) {}

void Progress::Step() {
  const MutexLock lock(mutex_);
  ++done_;
  if (!is_quiet_) Draw();
}

void Progress::Draw() {
  const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (line_.is_terminal()) {
    constexpr int kWidth = 30;
    const int filled = kWidth * done_ / total_;
    const std::string bar = std::string(static_cast<std::size_t>(filled), '=') +
                            std::string(static_cast<std::size_t>(kWidth - filled), ' ');
    char text[96];
    std::snprintf(text, sizeof text, "[%s] %d/%d frames, %.0f s left", bar.c_str(), done_, total_,
                  spent_s / done_ * (total_ - done_));
    line_.Draw(text);
  } else if (4 * done_ / total_ != 4 * (done_ - 1) / total_) {
    std::fprintf(stderr, "%d/%d frames in %.1f s\n", done_, total_, spent_s);
  }
}

}  // namespace dhpmap::simulator
