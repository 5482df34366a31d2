// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace dhpmap {

/// One line of stderr that is drawn over, for progress; only where that is a terminal that can do so.
/// Thread-compatible.
class TerminalLine {
 public:
  TerminalLine();
  /// Takes the line away.
  ~TerminalLine() { Clear(); }
  TerminalLine(const TerminalLine&) = delete;
  TerminalLine& operator=(const TerminalLine&) = delete;

  /// False: whoever has something to say says it in lines of its own, and few of them.
  [[nodiscard]] bool is_terminal() const { return is_terminal_; }
  /// In place of what was drawn before; cut to the width that the terminal has now, so that it stays one line.
  void Draw(const std::string& text);
  void Clear();

 private:
  const bool is_terminal_;
  bool is_drawn_ = false;
};

/// At most so many characters of UTF-8; what is cut off becomes "...".
std::string CutToWidth(const std::string& text, std::size_t width);

}  // namespace dhpmap
