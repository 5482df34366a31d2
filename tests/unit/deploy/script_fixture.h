// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace dhpmap {

/// A folder of its own for scripts of deploy/ to run in, with programs that are scripts.
class ScriptTest : public ::testing::Test {
 protected:
  struct Run {
    int exit_code = -1;
    std::string output;  ///< both streams

    [[nodiscard]] bool Says(const std::string& text) const { return output.find(text) != std::string::npos; }
    [[nodiscard]] std::string LastLine() const {
      const std::string::size_type end = output.find_last_not_of('\n');
      if (end == std::string::npos) return "";
      return output.substr(output.rfind('\n', end) + 1, end - output.rfind('\n', end));
    }
  };

  [[nodiscard]] std::filesystem::path Folder() const { return folder_.path(); }
  [[nodiscard]] static std::string Script(const std::string& name) {
    return (testing::SourceDir() / "deploy" / name).string();
  }

  void WriteFile(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((Folder() / name).parent_path());
    std::ofstream(Folder() / name) << text;
  }
  void WriteProgram(const std::string& name, const std::string& text) const {
    WriteFile(name, text);
    std::filesystem::permissions(Folder() / name, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] std::string ReadFile(const std::string& name) const {
    std::ifstream file(Folder() / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// `command` in Folder(), by the shell.
  [[nodiscard]] Run Shell(const std::string& command) const {
    FILE* pipe = popen(("cd '" + Folder().string() + "' && { " + command + "; } 2>&1").c_str(), "r");
    Run run;
    std::array<char, 4096> part{};
    for (size_t read = 0; (read = fread(part.data(), 1, part.size(), pipe)) > 0;) run.output.append(part.data(), read);
    const int status = pclose(pipe);
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    return run;
  }

 private:
  testing::TempDir folder_;
};

}  // namespace dhpmap
