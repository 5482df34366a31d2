// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace dhpmap {

/// A line of stderr that is redrawn, for progress; only on a terminal that supports it. Thread-compatible.
class TerminalLine {
 public:
  TerminalLine();
  /// Removes the line.
  ~TerminalLine() { Clear(); }
  TerminalLine(const TerminalLine&) = delete;
  TerminalLine& operator=(const TerminalLine&) = delete;

  /// False: print separate lines instead, and few of them.
  [[nodiscard]] bool is_terminal() const { return is_terminal_; }
  /// Replaces the line; truncated to the current width of the terminal, so that it stays one line.
  void Draw(const std::string& text);
  void Clear();

 private:
  const bool is_terminal_;
  bool is_drawn_ = false;
};

/// At most `width` characters of UTF-8; a truncated text ends with "...".
std::string CutToWidth(const std::string& text, std::size_t width);

}  // namespace dhpmap
