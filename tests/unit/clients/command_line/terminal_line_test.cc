// SPDX-License-Identifier: BSD-3-Clause
// On a terminal of the system's own kind, of which the test reads what it is told.
#include "clients/command_line/terminal_line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <string>

namespace dhpmap {
namespace {

/// What `run` writes to stderr while that is a terminal of so many columns.
std::string OnTerminal(unsigned short columns, const std::function<void()>& run) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return "no terminal";
  const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
  const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  ioctl(terminal, TIOCSWINSZ, &size);
  const int before = dup(STDERR_FILENO);
  dup2(terminal, STDERR_FILENO);
  run();
  fputs("END", stderr);
  fflush(stderr);
  dup2(before, STDERR_FILENO);
  std::string text;
  char part[256];
  while (!text.ends_with("END")) {
    const ssize_t num = read(master, part, sizeof part);
    if (num <= 0) break;
    text.append(part, static_cast<std::size_t>(num));
  }
  for (const int descriptor : {master, terminal, before}) close(descriptor);
  return text;
}

constexpr const char* kNewLine = "\r\x1b[K";

TEST(TerminalLine, IsOneLineHoweverNarrowTheTerminal) {
  setenv("TERM", "xterm", 1);
  const std::string told = OnTerminal(20, [] {
    TerminalLine line;
    EXPECT_TRUE(line.is_terminal());
    line.Draw("short");
    line.Draw("[======    ] 30/100 frames, 12.5 frames/s");
    line.Clear();
    line.Clear();
  });
  EXPECT_EQ(told, kNewLine + std::string("short") + kNewLine + "[======    ] 30/..." + kNewLine + "END");
}

TEST(TerminalLine, IsTakenAwayAtTheEnd) {
  setenv("TERM", "xterm", 1);
  EXPECT_EQ(OnTerminal(80, [] { TerminalLine().Draw("x"); }), kNewLine + std::string("x") + kNewLine + "END");
  EXPECT_EQ(OnTerminal(80, [] { TerminalLine line; }), "END") << "nothing was drawn";
}

TEST(TerminalLine, StaysOutOfPipesAndOfTerminalsThatCannotDrawOver) {
  ::testing::internal::CaptureStderr();
  {
    TerminalLine line;
    EXPECT_FALSE(line.is_terminal());
    line.Draw("x");
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  setenv("TERM", "dumb", 1);
  EXPECT_EQ(OnTerminal(80, [] { TerminalLine().Draw("x"); }), "END");
  unsetenv("TERM");
}

TEST(CutToWidth, CountsCharacters) {
  EXPECT_EQ(CutToWidth("sofa", 4), "sofa");
  EXPECT_EQ(CutToWidth("sofas and chairs", 8), "sofas...");
  EXPECT_EQ(CutToWidth("Küche", 5), "Küche");
  EXPECT_EQ(CutToWidth("Küchentür", 6), "Küc...");
  EXPECT_EQ(CutToWidth("sofa", 2), "so");
  EXPECT_EQ(CutToWidth("sofa", 0), "");
}

}  // namespace
}  // namespace dhpmap
