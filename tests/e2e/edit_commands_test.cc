// SPDX-License-Identifier: BSD-3-Clause
// Edits of voxels and lists of edits, as the client and curl ask for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

/// A server of its own with a mapped room: a ball and a box that stand apart on a floor, before a wall.
class EditCommands : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteRenderedDataset(root() / "dataset", 6);
    server_.emplace(root(), root() / "maps.db");
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
    const Outcome mapped = Run({"map", (root() / "dataset").string(), "--map", "room", "--labels", "groundtruth"});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
    ball_ = IdOf("ball");
    box_ = IdOf("box");
  }
  [[nodiscard]] std::filesystem::path root() const { return temp_.path(); }
  [[nodiscard]] Outcome Run(std::vector<std::string> arguments) const { return server_->Dhpmap(std::move(arguments)); }
  /// dhpmap edit `command` room `arguments`; must work. Returns what it says.
  std::string Edit(const std::string& command, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"edit", command, "room"});
    const Outcome edited = Run(arguments);
    EXPECT_EQ(edited.exit_code, 0) << command << ": " << edited.err;
    return edited.out;
  }
  int ExitCodeOfEdit(const std::string& command, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"edit", command, "room"});
    return Run(arguments).exit_code;
  }
  /// The instance id of the first object of a class.
  [[nodiscard]] std::string IdOf(const std::string& class_name) const {
    std::istringstream table(Run({"submaps", "room", "--class", class_name}).out);
    std::string heading, id;
    std::getline(table, heading);
    table >> id;
    EXPECT_FALSE(id.empty()) << "no " << class_name;
    return id;
  }
  [[nodiscard]] int NumOf(const std::string& class_name) const {
    const std::string table = Run({"submaps", "room", "--class", class_name}).out;
    return static_cast<int>(std::count(table.begin(), table.end(), '\n')) - 1;  // there is a heading
  }
  /// The first id that the text names after "changed", "created" or "removed"; empty if it does not.
  static std::string Named(const std::string& what, const std::string& text) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(what + " ([0-9]+)")) ? match[1].str() : std::string();
  }
  static int NumVoxels(const std::string& text) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(", ([0-9]+) voxels")) ? std::stoi(match[1]) : 0;
  }
  [[nodiscard]] std::string NameOf(const std::string& id) const { return "maps/room/submaps/" + id; }
  /// POST of a list of edits; what curl got.
  [[nodiscard]] Outcome Post(const std::string& body) const {
    return RunProgram(root(), {"curl", "-sf", server_->http_url() + "/v1/maps/room:applyEdits", "-d", body});
  }

  TempDir temp_;
  std::optional<ServerProcess> server_;
  std::string ball_, box_;
};

TEST_F(EditCommands, AnObjectIsTurnedShiftedAndPlacedOnAnother) {
  EXPECT_NE(Edit("turn", {box_, "30"}).find("changed " + box_), std::string::npos);
  EXPECT_NE(Edit("shift", {box_, "0.5", "-0.25", "1"}).find("changed " + box_), std::string::npos);
  EXPECT_NE(Edit("place", {ball_, box_, "--validate-only"}).find("would be: changed " + ball_), std::string::npos);
  EXPECT_NE(Edit("place", {ball_, box_, "--include-supported"}).find("changed " + ball_), std::string::npos);
  EXPECT_NE(Edit("shift", {box_, "0", "0", "1", "--include-supported"}).find("changed"), std::string::npos);
  EXPECT_EQ(ExitCodeOfEdit("place", {ball_, ball_}), 2) << "on itself";
  EXPECT_EQ(ExitCodeOfEdit("place", {ball_, box_, "--at", "90", "90"}), 2) << "there is no surface";
  EXPECT_EQ(ExitCodeOfEdit("turn", {ball_}), 1) << "by how much";
  const std::string table = Run({"submaps", "room", "--class", "box"}).out;
  EXPECT_TRUE(std::regex_search(table, std::regex("[0-9.]+ x [0-9.]+ x [0-9.]+"))) << table;
}

TEST_F(EditCommands, EachIsTriedAndMadeOnlyOnAStateThatIsAsExpected) {
  constexpr int kConflict = 4;
  const std::string before = Run({"submaps", "room"}).out;
  const int num_boxes = NumOf("box");
  EXPECT_NE(Edit("delete", {box_, "--validate-only"}).find("would be: deleted"), std::string::npos);
  EXPECT_NE(Edit("rename", {box_, "crate", "--validate-only"}).find("would be: renamed"), std::string::npos);
  EXPECT_NE(Edit("clone", {box_, "--to", "0", "0", "4", "--validate-only"}).find("would be: cloned"),
            std::string::npos);
  EXPECT_EQ(Run({"submaps", "room"}).out, before) << "only tried";
  Edit("rename", {box_, "crate"});
  EXPECT_EQ(ExitCodeOfEdit("delete", {box_, "--expected-revision", "1"}), kConflict);
  EXPECT_EQ(ExitCodeOfEdit("move", {box_, "--by", "0", "0", "1", "--etag", "0123456789abcdef-r1"}), kConflict);
  EXPECT_EQ(ExitCodeOfEdit("absent", {box_, "--etag", "0123456789abcdef-r1"}), kConflict);
  EXPECT_EQ(ExitCodeOfEdit("unignore-region", {"hall", "--etag", "0123456789abcdef-r1"}), kConflict) << "the map's";
  EXPECT_EQ(Run({"undo", "room", "--expected-revision", "1"}).exit_code, kConflict);
  Edit("delete", {box_});
  EXPECT_EQ(Run({"undelete", "room", box_, "--expected-revision", "1"}).exit_code, kConflict);
  EXPECT_NE(Run({"undelete", "room", box_, "--validate-only"}).out.find("would be: brought back"), std::string::npos);
  EXPECT_EQ(NumOf("box"), num_boxes - 1);
  EXPECT_EQ(Run({"undelete", "room", box_}).exit_code, 0);
  EXPECT_EQ(NumOf("box"), num_boxes);
}

TEST_F(EditCommands, SplitABoxOffAndMergeItAgain) {
  const std::vector<std::string> upper_half = {box_, "--box", "1", "0", "0.3", "2.2", "1.2", "1"};
  std::vector<std::string> tried = upper_half;
  tried.emplace_back("--validate-only");
  const std::string would = Edit("split", tried);
  EXPECT_TRUE(would.starts_with("would be: changed " + box_ + " created ")) << would;
  EXPECT_EQ(NumOf("box"), 1) << "only tried";

  const std::string split = Edit("split", upper_half);
  const std::string part = Named("created", split);
  ASSERT_FALSE(part.empty()) << split;
  EXPECT_EQ(Named("changed", split), box_);
  EXPECT_GT(NumVoxels(split), 100) << split;
  EXPECT_EQ(NumOf("box"), 2);
  EXPECT_EQ(ExitCodeOfEdit("split", {box_, "--box", "50", "50", "50", "51", "51", "51"}), 2) << "nothing lies there";

  EXPECT_EQ(ExitCodeOfEdit("merge", {box_, IdOf("floor")}), 2) << "a background";
  const std::string merged = Edit("merge", {box_, part});
  EXPECT_EQ(Named("changed", merged), box_) << merged;
  EXPECT_EQ(Named("removed", merged), part) << merged;
  EXPECT_EQ(NumOf("box"), 1);
  EXPECT_EQ(Run({"submaps", "room", part}).exit_code, 3);
  EXPECT_EQ(ExitCodeOfEdit("merge", {box_, part}), 3) << "it is a part of the other now";
}

TEST_F(EditCommands, SplitByAPlane) {
  const std::string split = Edit("split", {box_, "--plane", "1.6", "0.6", "0.3", "0", "0", "1"});
  EXPECT_FALSE(Named("created", split).empty()) << split;
  EXPECT_GT(NumVoxels(split), 100) << split;
  EXPECT_EQ(NumOf("box"), 2);
  EXPECT_EQ(ExitCodeOfEdit("split", {box_, "--plane", "0", "0", "9", "0", "0", "1"}), 2) << "nothing lies beyond";
  EXPECT_EQ(ExitCodeOfEdit("split", {box_, "--plane", "0", "0", "1"}), 1) << "no normal";
  EXPECT_EQ(ExitCodeOfEdit("split", {IdOf("floor"), "--plane", "1", "0", "0", "1", "0", "0"}), 2) << "a background";
}

TEST_F(EditCommands, SplitIntoPartsThatLieApart) {
  EXPECT_EQ(Named("removed", Edit("merge", {box_, ball_})), ball_);
  EXPECT_EQ(NumOf("ball"), 0);
  EXPECT_EQ(ExitCodeOfEdit("split", {box_, "--min-voxels", "1000000"}), 2) << "no part is so large";
  const std::string split = Edit("split", {box_});
  EXPECT_FALSE(Named("created", split).empty()) << split;
  EXPECT_GT(NumVoxels(split), 100) << split;
  EXPECT_EQ(NumOf("box"), 1);
  EXPECT_EQ(NumOf("ball"), 1) << "what its voxels were seen as";
}

TEST_F(EditCommands, ClearASphereOfOneObjectAndABoxOfAClass) {
  const std::vector<std::string> front = {"--sphere", "1.15", "-0.5", "0.35", "0.15", "--id", ball_};
  std::vector<std::string> tried = front;
  tried.emplace_back("--validate-only");
  const std::string would = Edit("clear", tried);
  EXPECT_TRUE(would.starts_with("would be: changed " + ball_)) << would;
  const std::string cleared = Edit("clear", front);
  EXPECT_EQ(Named("changed", cleared), ball_) << cleared;
  EXPECT_GT(NumVoxels(cleared), 10) << cleared;
  EXPECT_EQ(NumVoxels(cleared), NumVoxels(would));
  EXPECT_EQ(NumVoxels(Edit("clear", front)), 0) << "there is nothing left";

  const std::vector<std::string> around = {"--box", "0.9", "-1.2", "-0.3", "2.2", "0.2", "1.2"};
  std::vector<std::string> of_balls = around;
  of_balls.insert(of_balls.end(), {"--class", "Ball"});
  const std::string emptied = Edit("clear", of_balls);
  EXPECT_EQ(Named("removed", emptied), ball_) << emptied;
  EXPECT_EQ(Named("changed", emptied), "") << emptied;
  EXPECT_EQ(NumOf("ball"), 0);
  const std::string rest = Edit("clear", around);
  EXPECT_FALSE(Named("changed", rest).empty()) << "the floor below it, now that nobody asks for a class: " << rest;
  EXPECT_EQ(ExitCodeOfEdit("clear", {}), 1) << "where?";
  EXPECT_EQ(ExitCodeOfEdit("clear", {"--sphere", "0", "0", "0", "1", "--box", "0", "0", "0", "1", "1", "1"}), 1);
}

TEST_F(EditCommands, SayThatAnObjectIsAbsentAndThatItIsPresentAgain) {
  EXPECT_EQ(Named("changed", Edit("absent", {box_})), box_);
  EXPECT_NE(Run({"submaps", "room"}).out.find("absent"), std::string::npos);
  EXPECT_EQ(Named("changed", Edit("absent", {box_})), "") << "it is so already";
  EXPECT_EQ(Named("changed", Edit("present", {box_})), box_);
  EXPECT_EQ(Run({"submaps", "room"}).out.find("absent"), std::string::npos);
  EXPECT_EQ(ExitCodeOfEdit("absent", {IdOf("floor")}), 2) << "a background never is";
  EXPECT_EQ(ExitCodeOfEdit("absent", {"99999"}), 3);
}

TEST_F(EditCommands, ApplyAListFromAFileAsOne) {
  const std::filesystem::path list = root() / "list.json", bad = root() / "bad.json", broken = root() / "broken.json";
  const std::string made = R"({"submap": ")" + NameOf(box_) + R"(", "clone": {"displayName": "twin"}},
    {"submap": "#0", "lock": {}},
    {"submap": "#0", "split": {"plane": {"pointM": {"x": 1.6, "y": 0.6, "z": 0.3}, "normal": {"z": 1}}}},
    {"submap": "#0", "merge": {"merged_submaps": ["#2"]}},
    {"ignoreRegion": {"name": "door", "sphere": {"centerM": {"z": 9}, "radiusM": 1}}})";
  std::ofstream(list) << R"({"edits": [)" << made << "]}";
  std::ofstream(bad) << R"({"edits": [)" << made << R"(, {"unignore_region": {"name": "nothing"}}]})";
  std::ofstream(broken) << R"({"edits": [)";
  const auto num_lines = [](const std::string& text, const std::string& beginning) {
    int num = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) num += line.starts_with(beginning);
    return num;
  };
  EXPECT_EQ(num_lines(Edit("apply", {list.string(), "--validate-only"}), "would be:"), 5);
  EXPECT_EQ(NumOf("box"), 1) << "only tried";
  EXPECT_EQ(ExitCodeOfEdit("apply", {bad.string()}), 3) << "the last one fails";
  EXPECT_EQ(NumOf("box"), 1) << "so none was made";
  EXPECT_EQ(ExitCodeOfEdit("apply", {broken.string()}), 7);
  EXPECT_EQ(ExitCodeOfEdit("apply", {(root() / "nowhere.json").string()}), 7);

  const std::string applied = Edit("apply", {list.string(), "--author", "anna"});
  EXPECT_EQ(num_lines(applied, "done:"), 5) << applied;
  EXPECT_EQ(NumOf("box"), 2);
  const std::string twin = Named("created", applied);
  const std::string shown = Run({"submaps", "room", twin, "--json"}).out;
  EXPECT_NE(shown.find("\"display_name\": \"twin\""), std::string::npos) << shown;
  EXPECT_NE(shown.find("\"locked\": true"), std::string::npos) << shown;
  EXPECT_NE(Run({"edit", "ignored-regions", "room"}).out.find("door"), std::string::npos);
  EXPECT_EQ(Run({"undo", "room", "--author", "anna"}).exit_code, 0) << "all of it is one edit";
  EXPECT_EQ(NumOf("box"), 1);
  EXPECT_EQ(Run({"edit", "ignored-regions", "room"}).out.find("door"), std::string::npos);
}

TEST_F(EditCommands, CurlMakesEveryEdit) {
  const std::string on_box = R"({"submap": ")" + NameOf(box_) + R"(", )";
  const std::vector<std::pair<std::string, std::string>> edits = {
      {"move", on_box + R"("move": {"mapFromSubmap": {"translationM": {"z": 1}, "rotation": {"w": 1}}}})"},
      {"clone", on_box + R"("clone": {"displayName": "twin"}})"},
      {"delete", on_box + R"("delete": {}})"},
      {"relabel", on_box + R"("relabel": {"className": "Ball"}})"},
      {"rename", on_box + R"("rename": {"displayName": "crate"}})"},
      {"merge", on_box + R"("merge": {"merged_submaps": [")" + NameOf(ball_) + R"("]}})"},
      {"split by box", on_box + R"("split": {"box": {"minM": {"z": 0.3}, "maxM": {"x": 3, "y": 3, "z": 3}}}})"},
      {"split by plane", on_box + R"("split": {"plane": {"pointM": {"z": 0.3}, "normal": {"z": 1}}}})"},
      {"clear a box", R"({"clear": {"box": {"minM": {}, "maxM": {"x": 3, "y": 3, "z": 3}}}})"},
      {"clear a sphere",
       on_box + R"("clear": {"sphere": {"centerM": {"x": 1.35, "y": 0.6, "z": 0.3}, "radiusM": 0.2}}})"},
      {"clear a sphere of a class", R"({"clear": {"sphere": {"centerM": {}, "radiusM": 9}, "classNames": ["Ball"]}})"},
      {"absent", on_box + R"("presence": {"presence": "ABSENT"}})"},
      {"lock", on_box + R"("lock": {}})"},
      {"keep clear", R"({"ignoreRegion": {"name": "hall", "box": {"minM": {}, "maxM": {"x": 1, "y": 1, "z": 1}}}})"}};
  const std::string before = Run({"submaps", "room"}).out;
  for (const auto& [name, edit] : edits) {
    SCOPED_TRACE(name);
    const Outcome tried = Post(R"({"validateOnly": true, "edits": [)" + edit + "]}");
    EXPECT_EQ(tried.exit_code, 0) << tried.err;
    EXPECT_EQ(Run({"submaps", "room"}).out, before) << "only tried";
    const Outcome made = Post(R"({"author": "curl", "edits": [)" + edit + "]}");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.out.find("\"results\""), std::string::npos) << made.out;
    const Outcome undone = Run({"undo", "room", "--author", "curl"});
    ASSERT_EQ(undone.exit_code, 0) << undone.err;
  }
  const auto make = [this](const std::string& edit) { return Post(R"({"edits": [)" + edit + "]}").exit_code; };
  EXPECT_EQ(make(on_box + R"("presence": {"presence": "ABSENT"}})"), 0);
  EXPECT_EQ(make(on_box + R"("presence": {"presence": "PRESENT"}})"), 0);
  EXPECT_EQ(make(on_box + R"("lock": {}})"), 0);
  EXPECT_EQ(make(on_box + R"("unlock": {}})"), 0);
  const int num_boxes = NumOf("box");
  EXPECT_EQ(make(on_box + R"("delete": {}})"), 0);
  EXPECT_EQ(NumOf("box"), num_boxes - 1);
  EXPECT_EQ(make(on_box + R"("undelete": {}})"), 0);
  EXPECT_EQ(NumOf("box"), num_boxes);
  EXPECT_NE(make(on_box + R"("undelete": {}})"), 0) << "it is there";
  EXPECT_EQ(make(on_box + R"("delete": {}})"), 0);
  const std::string undelete = server_->http_url() + "/v1/" + NameOf(box_) + ":undelete";
  EXPECT_EQ(RunProgram(root(), {"curl", "-sf", undelete, "-d", "{}"}).exit_code, 0);
  EXPECT_EQ(NumOf("box"), num_boxes);
  EXPECT_EQ(make(R"({"ignoreRegion": {"name": "hall", "sphere": {"centerM": {"z": 9}, "radiusM": 1}}})"), 0);
  EXPECT_EQ(make(R"({"unignore_region": {"name": "hall"}})"), 0);
  EXPECT_EQ(make(on_box + R"("merge": {"merged_submaps": [")" + NameOf(ball_) + R"("]}})"), 0);
  EXPECT_EQ(make(on_box + R"("split": {"parts": {"minVoxels": 16}}})"), 0);
  EXPECT_NE(make(R"({"unignore_region": {"name": "hall"}})"), 0);
  const std::string last = Post(R"({"edits": [)" + on_box + R"("rename": {"displayName": "told"}}]})").out;
  std::smatch revision;
  ASSERT_TRUE(std::regex_search(last, revision, std::regex("\"revision\": ?\"?([0-9]+)"))) << last;
  const Outcome watched = Run({"watch", "room", "--from", "1", "--until", revision[1].str()});
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  EXPECT_NE(watched.out.find("  cleared box 0.00 0.00 0.00 to 3.00 3.00 3.00 m: "), std::string::npos) << watched.out;
  EXPECT_NE(watched.out.find("  ignored 'hall': sphere 0.00 0.00 9.00 of 1.00 m\n"), std::string::npos);
  EXPECT_NE(watched.out.find("  unignored 'hall': sphere"), std::string::npos);
}

TEST_F(EditCommands, WhatOthersHaveWrittenDoesNotActOnTheTerminal) {
  const std::string evil = "sofa\x1b[2J\n9  thing", shown = "sofa\\x1b[2J\\n9  thing";
  ASSERT_EQ(Run({"edit", "--author", evil, "rename", "room", ball_, evil}).exit_code, 0);
  const Outcome renamed = Run({"--json", "maps", "rename", "room", evil});
  ASSERT_EQ(renamed.exit_code, 0) << renamed.err;
  const std::string last = Run({"--json", "maps", "show", "room"}).out;
  std::smatch revision;
  ASSERT_TRUE(std::regex_search(last, revision, std::regex("\"revision\": ?\"?([0-9]+)"))) << last;
  const std::vector<std::string> watch = {"watch", "room", "--from", "1", "--until", revision[1].str()};
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"submaps", "room"}, {"log", "room"}, {"maps"}, {"maps", "show", "room"}, watch}) {
    const Outcome told = Run(command);
    EXPECT_EQ(told.exit_code, 0) << command[0] << told.err;
    EXPECT_EQ(told.out.find('\x1b'), std::string::npos) << command[0];
    EXPECT_NE(told.out.find(shown), std::string::npos) << command[0] << "\n" << told.out;
  }
}

}  // namespace
}  // namespace dhpmap::testing
