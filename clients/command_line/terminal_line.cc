// SPDX-License-Identifier: BSD-3-Clause
#include "clients/command_line/terminal_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace dhpmap {
namespace {

bool IsTerminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && (kind == nullptr || std::string_view(kind) != "dumb");
}

std::size_t TerminalWidth() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

}  // namespace

TerminalLine::TerminalLine() : is_terminal_(IsTerminal()) {}

void TerminalLine::Draw(const std::string& text) {
  if (!is_terminal_) return;
  // The last column stays empty, because many terminals wrap after writing to it.
  std::fprintf(stderr, "\r\x1b[K%s", CutToWidth(text, TerminalWidth() - 1).c_str());
  std::fflush(stderr);
  is_drawn_ = true;
}

void TerminalLine::Clear() {
  if (is_drawn_) std::fputs("\r\x1b[K", stderr);
  is_drawn_ = false;
}

std::string CutToWidth(const std::string& text, std::size_t width) {
  constexpr std::string_view kRest = "...";
  const auto end_of = [&text](std::size_t num_characters) {
    std::size_t at = 0;
    for (std::size_t n = 0; at < text.size(); ++at) {
      const bool begins = (static_cast<unsigned char>(text[at]) & 0xc0) != 0x80;
      if (begins && ++n > num_characters) break;
    }
    return at;
  };
  if (end_of(width) == text.size()) return text;
  if (width <= kRest.size()) return text.substr(0, end_of(width));
  return text.substr(0, end_of(width - kRest.size())).append(kRest);
}

}  // namespace dhpmap
