// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/eventually.h"

namespace dhpmap::testing {

/// How long what may take a while is waited for: only what hangs needs it.
inline constexpr double kPatience_s = std::chrono::duration<double>(kPatience).count();

/// A program of ours or of the system, with its output in files. Killed at the end of life.
class Process {
 public:
  /// `arguments[0]` is a path, or a name looked up in PATH. Output goes to `log_dir`/{stdout,stderr}.<n>.
  Process(const std::filesystem::path& log_dir, std::vector<std::string> arguments);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void Signal(int signal) const;
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Exit code, or 128 + signal; empty if it still runs after `timeout_s`.
  std::optional<int> Wait(double timeout_s = kPatience_s);
  [[nodiscard]] std::string Stdout() const;
  [[nodiscard]] std::string Stderr() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  std::filesystem::path stdout_, stderr_;
};

/// What a program that has ended said.
struct Outcome {
  int exit_code = -1;  ///< -1: it did not end in time
  std::string out, err;
};
Outcome RunProgram(const std::filesystem::path& log_dir, std::vector<std::string> arguments,
                   double timeout_s = kPatience_s);

/// bin/`name` of this build.
std::string Program(const std::string& name);

}  // namespace dhpmap::testing
