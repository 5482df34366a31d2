// SPDX-License-Identifier: BSD-3-Clause
// What the programs do for who types: versions, typos, completion, questions, and turns on the spot.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/e2e/mapped_room.h"
#include "tests/e2e/server_process.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

class CommandHelp : public MappedRoom {
 protected:
  static Outcome Run(std::vector<std::string> arguments) { return server_->Dhpmap(std::move(arguments)); }
  static Outcome Shell(const std::string& command) { return RunProgram(temp_->path(), {"bash", "-c", command}); }
  /// `dhpmap ARGUMENTS` on a terminal where somebody types `typed`.
  static Outcome OnTerminal(const std::string& arguments, const std::string& typed) {
    return Shell("printf '" + typed + "\\n' | script -qec '" + Program("dhpmap") + " --server " +
                 server_->grpc_address() + " " + arguments + "' /dev/null");
  }
  static bool HasMap(const std::string& name) { return Run({"maps", "show", name}).exit_code == 0; }
  /// The middle of an object's bounding sphere, on the axis `axis`.
  static double MiddleOf(const std::string& id, const char* axis) {
    const std::string text = Run({"submaps", "room", id, "--json"}).out;
    const std::string sphere = text.substr(text.find("\"bounding_sphere\""));
    std::smatch found;
    const std::regex number("\"" + std::string(axis) + "\": (-?[0-9.e-]+)");
    return std::regex_search(sphere, found, number) ? std::stod(found[1]) : 1e9;
  }
};

TEST_F(CommandHelp, EveryProgramTellsTheVersionOfTheProject) {
  std::ifstream in(SourceDir() / "CMakeLists.txt");
  const std::string cmake{std::istreambuf_iterator<char>(in), {}};
  std::smatch version;
  ASSERT_TRUE(std::regex_search(cmake, version, std::regex(R"(project\(dhpmap VERSION ([0-9.]+) )")));
  for (const char* name : {"dhpmap", "dhpmap-server", "dhpmap-simulate", "dhpmap-evaluate"}) {
    const Outcome outcome = RunProgram(temp_->path(), {Program(name), "--version"});
    EXPECT_EQ(outcome.exit_code, 0) << name;
    EXPECT_EQ(outcome.out, name + (" " + version[1].str()) + "\n");
  }
}

TEST_F(CommandHelp, ThePageOfCommandsSaysWhatProgramsSay) {
  std::ifstream in(SourceDir() / "docs/cli.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string bin = std::filesystem::path(Program("dhpmap")).parent_path();
  const Outcome outcome = RunProgram(temp_->path(), {SourceDir() / "docs/make_cli_page.py", bin});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, page) << "docs/make_cli_page.py says how to make it anew";
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 140u) << line;
}

TEST_F(CommandHelp, ATypoSaysWhatWasNear) {
  const auto told = [](std::vector<std::string> arguments, const std::string& near) {
    const Outcome outcome = Run(std::move(arguments));
    EXPECT_NE(outcome.exit_code, 0);
    return outcome.err.find("did you mean '" + near + "'?") != std::string::npos ? "" : outcome.out + outcome.err;
  };
  EXPECT_EQ(told({"submap", "room"}, "submaps"), "");
  EXPECT_EQ(told({"query", "pont", "room", "0", "0", "0"}, "point"), "");
  EXPECT_EQ(told({"submaps", "room", "--clas", "ball"}, "--class"), "");
  EXPECT_EQ(told({"submaps", "room", "--class", "bal"}, "Ball"), "");
  EXPECT_EQ(told({"submaps", "rom"}, "room"), "");
  EXPECT_EQ(told({"query", "distances", "room", "0", "0", "0", "--exclude-class", "flor"}, "Floor"), "");
  EXPECT_EQ(told({"edit", "relabel", "room", "1", "bax"}, "Box"), "");
  EXPECT_EQ(told({"maps", "create", "x", "--set", "voxel_size=0.1"}, "voxel_size_m"), "");
}

TEST_F(CommandHelp, ClassesAreNamedAlikeEverywhere) {
  for (const char* name : {"Ball", "ball", " BALL "}) {
    SCOPED_TRACE(name);
    const Outcome listed = Run({"submaps", "room", "--class", name});
    EXPECT_NE(listed.out.find("Ball"), std::string::npos) << listed.err;
    const std::vector<std::string> query = {"query", "distances", "room", "1.16", "-.5", ".45"};
    std::vector<std::string> with = query, only = query;
    with.insert(with.end(), {"--exclude-class", name});
    only.insert(only.end(), {"--class", name});
    EXPECT_EQ(Run(with).exit_code, 0);
    EXPECT_EQ(Run(with).out.find("Ball"), std::string::npos);
    EXPECT_NE(Run(only).out.find("Ball"), std::string::npos);
    const Outcome found = Run({"query", "search", "room", "--class", name});
    EXPECT_NE(found.out.find("Ball"), std::string::npos) << found.err;
    EXPECT_EQ(
        Run({"edit", "clear", "room", "--class", name, "--sphere", "50", "50", "50", "1", "--validate-only"}).exit_code,
        0);
  }
}

TEST_F(CommandHelp, DeletingAMapAsksFirst) {
  ASSERT_EQ(Run({"maps", "create", "spare"}).exit_code, 0);
  const Outcome refused = Run({"maps", "delete", "spare"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("--yes"), std::string::npos) << refused.err;
  EXPECT_TRUE(HasMap("spare")) << "nobody was there to be asked";

  const Outcome no = OnTerminal("maps delete spare", "n");
  EXPECT_NE(no.out.find("Delete maps/spare with all its submaps (1)"), std::string::npos) << no.out << no.err;
  EXPECT_TRUE(HasMap("spare"));
  const Outcome yes = OnTerminal("maps delete spare", "y");
  EXPECT_EQ(yes.exit_code, 0) << yes.out << yes.err;
  EXPECT_FALSE(HasMap("spare"));

  ASSERT_EQ(Run({"maps", "create", "spare"}).exit_code, 0);
  EXPECT_EQ(Run({"maps", "delete", "spare", "--yes"}).exit_code, 0);
  EXPECT_FALSE(HasMap("spare"));
  EXPECT_EQ(Run({"maps", "delete", "spare"}).exit_code, 3) << "there is nothing to ask about";
}

TEST_F(CommandHelp, BashCompletesCommandsAndNamesOfMaps) {
  const auto completed = [](const std::string& words, int last) {
    return Shell("source <('" + Program("dhpmap") + "' completion bash); COMP_WORDS=('" + Program("dhpmap") + "' " +
                 words + "); COMP_CWORD=" + std::to_string(last) + "; COMP_LINE='dhpmap --server " +
                 server_->grpc_address() + "'; _dhpmap; echo \"${COMPREPLY[*]}\"")
        .out;
  };
  EXPECT_EQ(completed("subm", 1), "submaps\n");
  EXPECT_EQ(completed("edit mo", 2), "move\n");
  EXPECT_EQ(completed("edit move --ya", 3), "--yaw\n");
  EXPECT_EQ(completed("submaps --kind ''", 3), "thing stuff\n");
  EXPECT_EQ(completed("submaps ro", 2), "room\n") << "the server knows";
  EXPECT_EQ(completed("map --map ro", 3), "room\n");
}

TEST_F(CommandHelp, AnObjectIsTurnedOnTheSpot) {
  std::istringstream table(Run({"submaps", "room", "--class", "box"}).out);
  std::string heading, id;
  std::getline(table, heading);
  table >> id;
  const double x = MiddleOf(id, "x"), y = MiddleOf(id, "y"), z = MiddleOf(id, "z");
  ASSERT_GT(std::hypot(x, y), 0.5) << "not at the origin, where all turns are on the spot";
  const Outcome turned = Run({"edit", "move", "room", id, "--yaw", "90"});
  ASSERT_EQ(turned.exit_code, 0) << turned.err;
  EXPECT_NEAR(MiddleOf(id, "x"), x, 1e-6);
  EXPECT_NEAR(MiddleOf(id, "y"), y, 1e-6);
  EXPECT_NEAR(MiddleOf(id, "z"), z, 1e-6);
  ASSERT_EQ(Run({"edit", "move", "room", id, "--yaw", "-90", "--by", "0", "0", "1"}).exit_code, 0);
  EXPECT_NEAR(MiddleOf(id, "z"), z + 1, 1e-6);
  EXPECT_EQ(Run({"edit", "move", "room", id, "--yaw", "90", "--rotation", "0", "0", "0", "1"}).exit_code, 1);
  const Outcome copy = Run({"edit", "clone", "room", id, "--yaw", "45", "--by", "2", "0", "0"});
  EXPECT_EQ(copy.exit_code, 0) << copy.err;
}

}  // namespace
}  // namespace dhpmap::testing
