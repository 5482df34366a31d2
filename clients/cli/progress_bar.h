// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "clients/command_line/terminal_line.h"
#include "mapping/base/mutex.h"

namespace dhpmap {

/// Progress on stderr: a bar on a terminal, else a line for every tenth. Thread-safe.
class ProgressBar {
 public:
  /// `unit`: of `total`; "bytes" are shown in suitable units.
  explicit ProgressBar(std::size_t total, std::string unit = "frames");
  /// Removes the bar.
  ~ProgressBar() = default;
  void Show(std::size_t done, const std::string& note);
  /// Prints a line above the bar.
  void Print(const std::string& line);
  [[nodiscard]] double elapsed_s() const;

 private:
  void Draw(std::size_t done, const std::string& note) DHPMAP_REQUIRES(mutex_);

  [[nodiscard]] std::string Counted(std::size_t done) const;

  const std::size_t total_;
  const std::string unit_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Mutex mutex_;
  TerminalLine line_ DHPMAP_GUARDED_BY(mutex_);
  bool is_drawn_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::size_t tenths_shown_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::chrono::steady_clock::time_point drawn_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
