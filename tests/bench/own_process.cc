// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/own_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "mapping/base/guarded.h"

namespace dhpmap::bench {
namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(2);

bool WriteAll(int to, std::string_view text) {
  while (!text.empty()) {
    const ssize_t num_written = write(to, text.data(), text.size());
    if (num_written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(num_written));
  }
  return true;
}

std::string ReadAll(int from) {
  std::string text;
  std::array<char, 4096> part;
  for (ssize_t num_read; (num_read = read(from, part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(num_read));
  }
  return text;
}

/// Begins what a process tells: the text that was given, or the number of a StatusCode, a line's end and its message.
constexpr char kGiven = 'g', kFailed = 'f';

/// Never returns: nothing of the parent's is to be cleared away here.
[[noreturn]] void WorkAndTell(const std::function<Result<std::string>()>& work, int to) {
  const auto outcome = Guarded<Result<std::string>>(work);
  const std::string told = outcome.ok() ? kGiven + *outcome
                                        : kFailed + std::to_string(static_cast<int>(outcome.status().code())) + '\n' +
                                              outcome.status().message();
  _exit(WriteAll(to, told) ? 0 : 1);
}

Result<std::string> OutcomeIn(const std::string& told) {
  if (told.starts_with(kGiven)) return told.substr(1);
  const std::size_t line_end = told.find('\n');
  if (!told.starts_with(kFailed) || line_end == std::string::npos) {
    return Internal("a measuring process did not tell its outcome");
  }
  return Status(static_cast<StatusCode>(std::atoi(told.c_str() + 1)), told.substr(line_end + 1));
}

}  // namespace

Result<std::string> InOwnProcess(const std::function<Result<std::string>()>& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return Unavailable("no pipe to another process");
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    WorkAndTell(work, ends[1]);
  }
  close(ends[1]);
  const std::string told = child > 0 ? ReadAll(ends[0]) : "";
  close(ends[0]);
  if (child < 0) return Unavailable("no other process");
  int state = 0;
  waitpid(child, &state, 0);
  if (WIFSIGNALED(state)) return Internal("a measuring process died of signal " + std::to_string(WTERMSIG(state)));
  return OutcomeIn(told);
}

std::int64_t AnonymousBytes() {
  std::ifstream pages("/proc/self/statm");
  std::int64_t all = 0, resident = 0, of_files = 0;
  if (!(pages >> all >> resident >> of_files)) return 0;
  return (resident - of_files) * sysconf(_SC_PAGESIZE);
}

std::int64_t AvailableBytes() {
  std::ifstream values("/proc/meminfo");
  std::string key;
  for (std::int64_t kib = 0; values >> key >> kib;) {
    if (key == "MemAvailable:") return kib << 10;
    values.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0;
}

AnonymousPeak::AnonymousPeak()
    : looker_([this] {
        while (!is_over_) {
          peak_bytes_ = std::max(peak_bytes_.load(), AnonymousBytes());
          std::this_thread::sleep_for(kLookEvery);
        }
      }) {}

AnonymousPeak::~AnonymousPeak() {
  is_over_ = true;
  looker_.join();
}

}  // namespace dhpmap::bench
