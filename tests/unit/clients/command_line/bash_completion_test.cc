// SPDX-License-Identifier: BSD-3-Clause
// The script is run by bash itself, which says what it would complete.
#include "clients/command_line/bash_completion.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

/// What a shell prints.
std::string Shell(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> part{};
  while (fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
  return text;
}

class BashCompletionTest : public ::testing::Test {
 protected:
  BashCompletionTest() : app_("test", "my-tool") {
    app_.fallthrough();
    app_.add_option("--server", server_, "Where");
    app_.add_flag("--json", is_json_);
    CLI::App* show = app_.add_subcommand("show", "");
    show->add_option("map", map_);
    show->add_option("--kind", kind_)->check(CLI::IsMember({"thing", "stuff"}));
    show->add_option("--near", near_m_)->expected(4);
    CLI::App* query = app_.add_subcommand("query", "");
    query->add_subcommand("point", "")->add_option("map", map_);
    query->add_subcommand("distances", "")->add_option("--map", map_);
    app_.add_subcommand("secret", "")->group("");
    // The tool itself: prints names of maps, and where it was told to look.
    std::ofstream(Tool()) << "#!/bin/sh\necho kitchen; echo office; echo '$(touch " << Evil().string()
                          << ")'; [ \"$1\" = --server ] && echo \"at-$2\"\nexit 0\n";
    std::filesystem::permissions(Tool(), std::filesystem::perms::owner_all);
    std::ofstream(Script()) << BashCompletion(app_, {.name = "map", .command = "completion maps"});
  }
  [[nodiscard]] std::filesystem::path Tool() const { return temp_.path() / "my-tool"; }
  [[nodiscard]] std::filesystem::path Script() const { return temp_.path() / "script"; }
  [[nodiscard]] std::filesystem::path Evil() const { return temp_.path() / "evil"; }

  /// What completes the last of the words, which follow the program's name.
  [[nodiscard]] std::string Completed(const std::vector<std::string>& words) const {
    std::string list = "'" + Tool().string() + "'", line = "my-tool";
    for (const std::string& word : words) list += " '" + word + "'", line += " " + word;
    return Shell("bash -uc \"source '" + Script().string() + "'; COMP_WORDS=(" + list +
                 "); COMP_CWORD=" + std::to_string(words.size()) + "; COMP_LINE='" + line +
                 "'; _my_tool; echo -n \\\"\\${COMPREPLY[@]-}\\\"\" 2>&1");
  }

  testing::TempDir temp_;
  CLI::App app_;
  std::string server_, map_, kind_;
  std::vector<double> near_m_;
  bool is_json_ = false;
};

TEST_F(BashCompletionTest, CompletesCommands) {
  EXPECT_EQ(Completed({""}), "show query") << "hidden commands stay so";
  EXPECT_EQ(Completed({"qu"}), "query");
  EXPECT_EQ(Completed({"query", ""}), "point distances");
  EXPECT_EQ(Completed({"--json", "query", "di"}), "distances");
  EXPECT_EQ(Completed({"--server", "show", "que"}), "query") << "an option's value is no command";
  EXPECT_EQ(Completed({"fly", "x"}), "");
}

TEST_F(BashCompletionTest, CompletesOptionsOfTheCommandAndThoseAroundIt) {
  EXPECT_EQ(Completed({"show", "--k"}), "--kind");
  EXPECT_EQ(Completed({"show", "--"}), "--help --kind --near --server --json");
  EXPECT_EQ(Completed({"query", "point", "--js"}), "--json");
}

TEST_F(BashCompletionTest, CompletesValues) {
  EXPECT_EQ(Completed({"show", "--kind", ""}), "thing stuff");
  EXPECT_EQ(Completed({"show", "--kind", "=", "s"}), "stuff") << "bash makes a word of '='";
  EXPECT_EQ(Completed({"show", "--near", "1", "2", ""}), "") << "numbers: nothing to say";
  EXPECT_EQ(Completed({"show", "--near", "1", "2", "3", "4", "off"}), "office");
}

TEST_F(BashCompletionTest, AsksTheProgramForNamesThatItKnows) {
  EXPECT_EQ(Completed({"show", "k"}), "kitchen");
  EXPECT_EQ(Completed({"show", "kitchen", ""}), "") << "one map";
  EXPECT_EQ(Completed({"query", "distances", "--map", "o"}), "office");
  EXPECT_EQ(Completed({"--server", "robot", ":", "50051", "show", "at"}), "at-robot") << "words as bash cuts them";
  EXPECT_NE(Completed({"show", ""}).find("$(touch"), std::string::npos) << "what it says is text";
  EXPECT_FALSE(std::filesystem::exists(Evil())) << "and never a command";
}

}  // namespace
}  // namespace dhpmap
