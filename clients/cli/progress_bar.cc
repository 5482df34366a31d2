// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "clients/cli/text_table.h"

namespace dhpmap {
namespace {

constexpr std::size_t kWidth = 30;
constexpr char kBytes[] = "bytes";
constexpr auto kMinInterval = std::chrono::milliseconds(100);

}  // namespace

ProgressBar::ProgressBar(std::size_t total, std::string unit)
    : total_(std::max<std::size_t>(total, 1)), unit_(std::move(unit)) {}

double ProgressBar::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressBar::Show(std::size_t done, const std::string& note) {
  const auto now = std::chrono::steady_clock::now();
  const MutexLock lock(mutex_);
  if (line_.is_terminal()) {
    if (is_drawn_ && now - drawn_ < kMinInterval && done < total_) return;
    drawn_ = now;
    Draw(done, note);
    return;
  }
  const std::size_t tenths = 10 * done / total_;
  if (tenths == tenths_shown_) return;
  tenths_shown_ = tenths;
  std::fprintf(stderr, "%s%s, %s\n", Counted(done).c_str(), unit_ == kBytes ? "" : (" " + unit_).c_str(), note.c_str());
}

void ProgressBar::Print(const std::string& line) {
  const MutexLock lock(mutex_);
  line_.Clear();
  std::fprintf(stderr, "%s\n", line.c_str());
  is_drawn_ = false;
}

std::string ProgressBar::Counted(std::size_t done) const {
  if (unit_ != kBytes) return std::to_string(done) + "/" + std::to_string(total_);
  return Bytes(static_cast<double>(done)) + " of " + Bytes(static_cast<double>(total_));
}

void ProgressBar::Draw(std::size_t done, const std::string& note) {
  const std::size_t filled = std::min(kWidth, kWidth * done / total_);
  const std::string bar = std::string(filled, '=') + std::string(kWidth - filled, ' ');
  line_.Draw("[" + bar + "] " + Counted(done) + "  " + note);
  is_drawn_ = true;
}

}  // namespace dhpmap
