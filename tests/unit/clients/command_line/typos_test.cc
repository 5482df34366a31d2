// SPDX-License-Identifier: BSD-3-Clause
#include "clients/command_line/typos.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "clients/command_line/version.h"

namespace dhpmap {
namespace {

/// A program with commands, some of them below others; what it says of a command line, or nothing.
std::string Told(std::vector<std::string> arguments) {
  CLI::App app("test", "tool");
  app.fallthrough();
  app.require_subcommand(1);
  app.failure_message(ExplainParseError);
  bool is_json = false;
  int id = 0;
  std::string name;
  app.add_flag("--json", is_json);
  CLI::App* query = app.add_subcommand("query", "");
  query->require_subcommand(1);
  query->add_subcommand("point", "")->add_option("id", id);
  query->add_subcommand("distances", "")->add_option("--class", name);
  app.add_subcommand("hidden", "")->group("");
  std::reverse(arguments.begin(), arguments.end());
  std::ostringstream out, err;
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    app.exit(error, out, err);
  }
  return err.str();
}

bool Begins(const std::string& text, const std::string& beginning) { return text.starts_with(beginning + "\n"); }

TEST(ExplainParseError, SaysWhichCommandWasNear) {
  EXPECT_TRUE(Begins(Told({"qeury", "point"}), "tool has no command 'qeury'; did you mean 'query'?"));
  EXPECT_TRUE(Begins(Told({"query", "pint", "1"}), "tool query has no command 'pint'; did you mean 'point'?"));
  EXPECT_TRUE(Begins(Told({"query", "fly"}), "tool query has no command 'fly'; its commands: point, distances"));
  EXPECT_TRUE(Begins(Told({"hiden"}), "tool has no command 'hiden'; its commands: query")) << "hidden ones stay so";
}

TEST(ExplainParseError, SaysWhichOptionWasNear) {
  EXPECT_TRUE(Begins(Told({"query", "distances", "--clas=sofa"}),
                     "tool query distances has no option '--clas'; did you mean '--class'?"));
  EXPECT_TRUE(
      Begins(Told({"query", "point", "--jsno"}), "tool query point has no option '--jsno'; did you mean '--json'?"))
      << "also those of the commands around it";
  EXPECT_TRUE(Begins(Told({"query", "point", "--clas", "sofa"}), "tool query point has no option '--clas'"))
      << "not that sofa is no number";
  EXPECT_TRUE(Begins(Told({"query", "point", "--frobnicate"}), "tool query point has no option '--frobnicate'"));
}

TEST(ExplainParseError, LeavesAllElseToTheParser) {
  EXPECT_EQ(Told({"query", "point", "7"}), "");
  EXPECT_NE(Told({}).find("A subcommand is required"), std::string::npos);
  EXPECT_NE(Told({"query", "point", "seven"}).find("seven"), std::string::npos);
  EXPECT_NE(Told({"query", "point", "7", "8"}).find("not expected: 8"), std::string::npos);
}

TEST(VersionOf, IsTheProgramAndAVersion) {
  const std::string version = VersionOf("tool");
  EXPECT_TRUE(version.starts_with("tool ")) << version;
  EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 2) << version;
}

}  // namespace
}  // namespace dhpmap
