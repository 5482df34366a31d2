// SPDX-License-Identifier: BSD-3-Clause
// What a user sees of the client and of a server that cannot start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/server_process.h"
#include "tests/e2e/test_database.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

std::string FileBytes(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class CommandLine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("DHPMAP_SERVER", "127.0.0.1:1", 1);  // the flag goes before it, and it is no business of the server's
    temp_ = new TempDir();
    WriteRenderedDataset(temp_->path() / "dataset", 6);
    server_ = new ServerProcess(temp_->path(), temp_->path() / "maps.db");
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
    const Outcome outcome =
        server_->Dhpmap({"map", (temp_->path() / "dataset").string(), "--map", "room", "--labels", "groundtruth"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() {
    delete server_;
    delete temp_;
  }
  static Outcome Run(std::vector<std::string> arguments) { return server_->Dhpmap(std::move(arguments)); }
  static std::filesystem::path File(const char* name) { return temp_->path() / name; }

  static TempDir* temp_;
  static ServerProcess* server_;
};
TempDir* CommandLine::temp_ = nullptr;
ServerProcess* CommandLine::server_ = nullptr;

TEST_F(CommandLine, ListsMapsAndSubmapsForPeopleAndMachines) {
  EXPECT_NE(Run({"maps"}).out.find("room"), std::string::npos);
  EXPECT_NE(Run({"maps", "show", "room"}).out.find("voxel_size_m"), std::string::npos);
  const Outcome all = Run({"submaps", "room"});
  for (const char* name : {"Ball", "Box", "Floor", "Wall"}) EXPECT_NE(all.out.find(name), std::string::npos) << all.out;
  const Outcome balls = Run({"submaps", "room", "--class", "ball", "--json"});
  EXPECT_NE(balls.out.find("\"class_name\": \"Ball\""), std::string::npos) << balls.out;
  EXPECT_EQ(balls.out.find("Wall"), std::string::npos) << balls.out;
  EXPECT_EQ(Run({"submaps", "room", "--kind", "stuff", "--json"}).out.find("THING"), std::string::npos);
  EXPECT_NE(Run({"stats", "room"}).out.find("observed of"), std::string::npos);
}

TEST_F(CommandLine, QueriesPointsFromArgumentsAndFiles) {
  const Outcome typed = Run({"query", "point", "room", "1.16", "-.5", ".4", "9", "9", "9"});
  EXPECT_NE(typed.out.find("Ball"), std::string::npos) << typed.out << typed.err;
  EXPECT_NE(typed.out.find("unknown"), std::string::npos) << typed.out;
  std::ofstream(File("points.txt")) << "1.16,-.5,.4\n9 9 9\n";
  EXPECT_EQ(Run({"query", "point", "room", "--file", File("points.txt").string()}).out, typed.out);
}

TEST_F(CommandLine, QueriesDistancesWithAndWithoutObjects) {
  const std::vector<std::string> query = {"query", "distances", "room", "1.16", "-.5", ".45", "99", "9", "9"};
  const Outcome all = Run(query);
  EXPECT_NE(all.out.find("Ball"), std::string::npos) << all.out << all.err;
  EXPECT_NE(all.out.find("CLAMPED"), std::string::npos) << all.out;
  const auto with = [&query](std::vector<std::string> more) {
    more.insert(more.begin(), query.begin(), query.end());
    return Run(more);
  };
  EXPECT_EQ(with({"--exclude-class", "Ball"}).out.find("Ball"), std::string::npos);
  EXPECT_NE(with({"--class", "Floor"}).out.find("Floor"), std::string::npos);
  EXPECT_NE(with({"--json"}).out.find("\"status\": \"CLAMPED\""), std::string::npos);
  EXPECT_EQ(with({"--exclude-submap", "99999"}).exit_code, 3);
  EXPECT_EQ(with({"--exclude-class", "spoon"}).exit_code, 2);
  EXPECT_EQ(with({"--max-distance", "-1"}).exit_code, 2);
  EXPECT_NE(with({"--max-free-age-s", "3600", "--vacated-free"}).out.find("Ball"), std::string::npos);
  EXPECT_EQ(with({"--max-free-age-s", "-1"}).exit_code, 2) << "the flag reaches the server";
  EXPECT_NE(with({"--tolerance-vox", "0.5"}).out.find("Ball"), std::string::npos);
  EXPECT_EQ(with({"--tolerance-vox", "-1"}).exit_code, 2);
}

TEST_F(CommandLine, CastsRays) {
  const Outcome down = Run({"query", "rays", "room", "1.16", "-.5", "2", "0", "0", "-2", "--max-distance", "5"});
  EXPECT_NE(down.out.find("Ball"), std::string::npos) << down.out << down.err;
  const Outcome through = Run({"query", "rays", "room", "1.16", "-.5", "2", "0", "0", "-2", "--max-distance", "5",
                               "--exclude-class", "Ball", "--json"});
  EXPECT_NE(through.out.find("\"class_name\": \"Floor\""), std::string::npos) << through.out << through.err;
  EXPECT_EQ(Run({"query", "rays", "room", "0", "0", "0", "0", "0", "0"}).exit_code, 2) << "no direction";
  EXPECT_EQ(Run({"query", "rays", "room", "0", "0", "0", "1"}).exit_code, 1);
}

TEST_F(CommandLine, ChecksBodiesAndMotions) {
  const std::vector<std::string> query = {"query", "collisions", "room", "1.16", "-.5",       ".5",  ".2",
                                          "1.16",  "-.5",        "2",    ".1",   "--unknown", "free"};
  const Outcome spheres = Run(query);
  EXPECT_NE(spheres.out.find("yes"), std::string::npos) << spheres.out << spheres.err;
  EXPECT_NE(spheres.out.find("Ball"), std::string::npos) << spheres.out;
  EXPECT_NE(spheres.out.find("no"), std::string::npos) << spheres.out;
  const Outcome others =
      Run({"query",     "collisions", "room", "--box", "1.16", "-.5", ".5", ".2", ".2",    ".2",
           "--capsule", "1.16",       "-.5",  ".5",    "1.16", "-.5", "1",  ".1", "--all", "--json"});
  EXPECT_NE(others.out.find("\"colliding\": true"), std::string::npos) << others.out << others.err;
  EXPECT_EQ(Run({"query", "collisions", "room", "0", "0", "0"}).exit_code, 1);
  EXPECT_EQ(Run({"query", "collisions", "room", "0", "0", "0", "-1"}).exit_code, 2) << "no radius";
  std::vector<std::string> fall = {"query", "trajectory", "room",    "1.16", "-.5", "2", "0",  "1.16",      "-.5",
                                   ".5",    "0",          "--robot", "0",    "0",   "0", ".1", "--unknown", "free"};
  const Outcome stopped = Run(fall);
  EXPECT_NE(stopped.out.find("sphere 0"), std::string::npos) << stopped.out << stopped.err;
  EXPECT_NE(stopped.out.find("Ball"), std::string::npos) << stopped.out;
  fall.insert(fall.end(), {"--exclude-class", "Ball", "--json"});
  EXPECT_NE(Run(fall).out.find("\"valid\": true"), std::string::npos) << Run(fall).out << Run(fall).err;
  EXPECT_EQ(Run({"query", "trajectory", "room", "0", "0", "0"}).exit_code, 1);
}

TEST_F(CommandLine, WritesSlicesAsMapsForNav2) {
  const std::vector<std::string> query = {"query", "slice", "room", "--from", "0.1", "--to", "1", "--out"};
  for (const char* name : {"floor.pgm", "floor.png"}) {
    std::vector<std::string> arguments = query;
    arguments.push_back(File(name).string());
    const Outcome outcome = Run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("cells of 0.0"), std::string::npos) << outcome.out;
    EXPECT_GT(std::filesystem::file_size(File(name)), 100u);
    const std::string yaml = FileBytes(File("floor.yaml"));
    EXPECT_NE(yaml.find("image: '" + std::string(name) + "'"), std::string::npos) << yaml;
    EXPECT_NE(yaml.find("origin: ["), std::string::npos) << yaml;
  }
  EXPECT_TRUE(FileBytes(File("floor.pgm")).starts_with("P5\n"));
  std::set<std::string> pictures;  // what nobody has seen is grey, white or black
  for (const char* policy : {"report", "free", "occupied"}) {
    std::vector<std::string> arguments = query;
    arguments.insert(arguments.end(), {File("policy.pgm").string(), "--unknown", policy});
    ASSERT_EQ(Run(arguments).exit_code, 0);
    pictures.insert(FileBytes(File("policy.pgm")));
  }
  EXPECT_EQ(pictures.size(), 3u);
  EXPECT_EQ(Run({"query", "slice", "room", "--out", "floor.jpg"}).exit_code, 1);
  EXPECT_EQ(Run({"query", "slice", "room", "--from", "2", "--to", "1", "--out", File("no.pgm").string()}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(File("no.pgm")));
}

TEST_F(CommandLine, FindsAndRelatesObjectsAndWritesGrids) {
  const Outcome nearest = Run({"query", "search", "room", "--near", "1.16", "-.5", ".6", "--limit", "1"});
  EXPECT_NE(nearest.out.find("Ball"), std::string::npos) << nearest.out << nearest.err;
  EXPECT_EQ(nearest.out.find("Floor"), std::string::npos) << nearest.out;
  EXPECT_EQ(Run({"query", "search", "room", "--class", "spoon"}).exit_code, 2);
  const Outcome relations = Run({"query", "relations", "room", "--kind", "on", "--json"});
  EXPECT_NE(relations.out.find("\"revision\""), std::string::npos) << relations.out << relations.err;
  EXPECT_EQ(Run({"query", "relations", "room", "99999"}).exit_code, 3);
  const std::string npy = File("grid.npy").string();
  const Outcome grid =
      Run({"query", "grid", "room", "--box", "0", "0", "0", "0.5", "0.4", "0.3", "--resolution", "0.1", "--out", npy});
  EXPECT_NE(grid.out.find("6 x 5 x 4 distances"), std::string::npos) << grid.out << grid.err;
  EXPECT_EQ(FileBytes(File("grid.npy")).size(), 128 + 4 * 6 * 5 * 4u);
}

TEST_F(CommandLine, EditsObjects) {
  std::istringstream table(Run({"submaps", "room", "--class", "box"}).out);
  std::string line, id;
  std::getline(table, line);
  table >> id;
  const Outcome cloned = Run({"edit", "clone", "room", id, "--by", "0", "-2", "1", "--name", "second box"});
  ASSERT_EQ(cloned.exit_code, 0) << cloned.err;
  const std::size_t slash = cloned.out.rfind('/');
  const std::string copy = cloned.out.substr(slash + 1, cloned.out.find(',') - slash - 1);
  EXPECT_NE(Run({"query", "point", "room", "1.6", "-1.4", "1.59"}).out.find("Box"), std::string::npos);
  EXPECT_EQ(Run({"edit", "move", "room", copy, "--to", "0", "0", "3"}).exit_code, 0);
  EXPECT_EQ(Run({"query", "point", "room", "1.6", "-1.4", "1.59"}).out.find("Box"), std::string::npos);
  EXPECT_EQ(Run({"edit", "relabel", "room", copy, "ball"}).exit_code, 0);
  EXPECT_EQ(Run({"edit", "relabel", "room", copy, "wall"}).exit_code, 2) << "a thing stays a thing";
  EXPECT_EQ(Run({"edit", "relabel", "room", copy, "spoon"}).exit_code, 3);
  EXPECT_EQ(Run({"edit", "rename", "room", copy, "lamp"}).exit_code, 0);
  const Outcome shown = Run({"submaps", "room", copy, "--json"});
  EXPECT_NE(shown.out.find("\"display_name\": \"lamp\""), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("\"class_name\": \"Ball\""), std::string::npos) << shown.out;
  EXPECT_EQ(Run({"edit", "lock", "room", copy}).exit_code, 0);
  EXPECT_NE(Run({"submaps", "room"}).out.find(", locked"), std::string::npos);
  EXPECT_EQ(Run({"edit", "unlock", "room", copy}).exit_code, 0);
  EXPECT_EQ(Run({"edit", "ignore-region", "room", "door", "--box", "0", "0", "0", "1", "1", "2"}).exit_code, 0);
  EXPECT_EQ(Run({"edit", "ignore-region", "room", "door", "--sphere", "0", "0", "9", "1"}).exit_code, 4) << "is taken";
  EXPECT_EQ(Run({"edit", "clear", "room", "--sphere", "0", "0", "9", "1", "--ignore-region", "roof"}).exit_code, 0);
  const Outcome kept = Run({"edit", "ignored-regions", "room"});
  EXPECT_NE(kept.out.find("0.00 0.00 0.00 to 1.00 1.00 2.00"), std::string::npos) << kept.out;
  EXPECT_NE(kept.out.find("roof"), std::string::npos) << kept.out;
  EXPECT_EQ(Run({"edit", "unignore-region", "room", "door"}).exit_code, 0);
  EXPECT_EQ(Run({"edit", "unignore-region", "room", "door"}).exit_code, 3);
  EXPECT_EQ(Run({"edit", "delete", "room", copy}).exit_code, 0);
  EXPECT_EQ(Run({"edit", "delete", "room", copy}).exit_code, 3);
}

TEST_F(CommandLine, LogsUndoesAndRedoesEdits) {
  ASSERT_EQ(Run({"edit", "rename", "room", "1", "first", "--author", "anna"}).exit_code, 0);
  ASSERT_EQ(Run({"edit", "rename", "room", "1", "second", "--author", "anna"}).exit_code, 0);
  const Outcome log = Run({"log", "room", "--author", "anna", "-n", "2"});
  EXPECT_NE(log.out.find("anna  rename 1, changed 1"), std::string::npos) << log.out << log.err;
  EXPECT_EQ(std::count(log.out.begin(), log.out.end(), '\n'), 2);
  const auto name = [] { return Run({"submaps", "room", "1", "--json"}).out; };
  EXPECT_EQ(Run({"undo", "room", "--author", "anna", "--validate-only"}).exit_code, 0);
  EXPECT_NE(name().find("\"second\""), std::string::npos) << "only tried";
  EXPECT_EQ(Run({"undo", "room", "--author", "anna"}).exit_code, 0);
  EXPECT_NE(name().find("\"first\""), std::string::npos);
  EXPECT_EQ(Run({"redo", "room", "--author", "anna"}).exit_code, 0);
  EXPECT_NE(name().find("\"second\""), std::string::npos);
  EXPECT_NE(Run({"redo", "room", "--author", "anna"}).exit_code, 0) << "there is nothing left";
  const std::string url = server_->http_url() + "/v1/maps/room";
  const Outcome undone =
      RunProgram(temp_->path(), {"curl", "-sf", url + ":undoEdits", "-d", R"({"author": "anna", "count": 2})"});
  EXPECT_NE(undone.out.find("maps/room/edits/"), std::string::npos) << undone.out << undone.err;
  EXPECT_EQ(RunProgram(temp_->path(), {"curl", "-sf", url + ":redoEdits", "-d", R"({"author": "anna"})"}).exit_code, 0);
  EXPECT_NE(RunProgram(temp_->path(), {"curl", "-s", url + "/edits?author=anna"}).out.find("\"REDO\""),
            std::string::npos);
  ASSERT_EQ(Run({"edit", "delete", "room", "2"}).exit_code, 0);
  EXPECT_EQ(Run({"undelete", "room", "2"}).exit_code, 0);
  EXPECT_EQ(Run({"submaps", "room", "2"}).exit_code, 0);
}

TEST_F(CommandLine, ReadsThePastAndGoesBackToIt) {
  const std::string stats = Run({"stats", "room", "--json"}).out;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(stats, found, std::regex("\"revision\": \"([0-9]+)\""))) << stats;
  const std::string past = found[1].str();
  const Outcome one = Run({"submaps", "room", "1", "--json"}), all = Run({"submaps", "room"});
  const Outcome map = Run({"maps", "show", "room"});
  ASSERT_EQ(Run({"edit", "rename", "room", "1", "past-lamp", "--author", "carl"}).exit_code, 0);
  ASSERT_EQ(Run({"maps", "rename", "room", "Past title"}).exit_code, 0);
  EXPECT_NE(Run({"submaps", "room"}).out, all.out);
  EXPECT_EQ(Run({"submaps", "room", "--read-revision", past}).out, all.out);
  EXPECT_EQ(Run({"submaps", "room", "1", "--json", "--read-revision", past}).out, one.out);
  EXPECT_EQ(Run({"maps", "show", "room", "--read-revision", past}).out, map.out);
  EXPECT_NE(Run({"stats", "room", "--read-revision", past}).out.find("revision " + past), std::string::npos);
  const Outcome mesh = Run({"export", "ply", "room", "-o", File("past.ply").string(), "--read-revision", past});
  EXPECT_NE(mesh.out.find("of revision " + past), std::string::npos) << mesh.out << mesh.err;
  const Outcome voxels =
      Run({"export", "voxels", "room", "1", "-o", File("past.csv").string(), "--read-revision", past});
  EXPECT_NE(voxels.out.find("of revision " + past), std::string::npos) << voxels.out << voxels.err;
  const Outcome future = Run({"submaps", "room", "--read-revision", "99999999"});
  EXPECT_EQ(future.exit_code, 2) << future.out << future.err;

  const std::vector<std::string> restore = {"restore", "room", "--revision", past, "--author", "carl"};
  const auto with = [&restore](std::vector<std::string> more) {
    more.insert(more.begin(), restore.begin(), restore.end());
    return Run(more);
  };
  EXPECT_NE(with({"--validate-only"}).out.find("would be as in revision " + past + ", changed 1"), std::string::npos);
  EXPECT_NE(Run({"submaps", "room"}).out, all.out) << "only tried";
  EXPECT_EQ(with({"--submap", "1", "--expected-revision", past}).exit_code, 4) << "it was edited since";
  EXPECT_EQ(with({"--submap", "1"}).exit_code, 0);
  EXPECT_EQ(Run({"submaps", "room"}).out, all.out);
  const Outcome told = Run({"log", "room", "--author", "carl", "-n", "1"});
  EXPECT_NE(told.out.find("restore 1 to revision " + past + ", changed 1"), std::string::npos) << told.out;
  const std::string url = server_->http_url() + "/v1/maps/room";
  const Outcome whole =
      RunProgram(temp_->path(), {"curl", "-sf", url + ":restoreRevision", "-d", R"({"revision": ")" + past + R"("})"});
  EXPECT_NE(whole.out.find("\"revision\""), std::string::npos) << whole.out << whole.err;
  EXPECT_EQ(Run({"maps", "show", "room"}).out.find("Past title"), std::string::npos) << "the title, too";
  EXPECT_NE(with({"--submap", "77"}).exit_code, 0);
  const Outcome now = Run({"maps", "show", "room"});
  EXPECT_EQ(with({"--submap", "-1"}).exit_code, 1) << "not all of the map";
  EXPECT_EQ(Run({"maps", "show", "room"}).out, now.out);
}

TEST_F(CommandLine, RenamesAMapAsEveryEditIsMade) {
  const auto rename = [](const std::string& title, std::vector<std::string> more) {
    more.insert(more.begin(), {"maps", "rename", "room", title, "--author", "dora"});
    return Run(more);
  };
  const std::string before = Run({"maps", "show", "room"}).out;
  EXPECT_NE(rename("tried", {"--validate-only"}).out.find("would be called 'tried'"), std::string::npos);
  EXPECT_EQ(Run({"maps", "show", "room"}).out, before);
  const std::vector<std::string> once = {"--request-id", "00000000-0000-4000-8000-0000000000d0"};
  EXPECT_EQ(rename("of dora", once).exit_code, 0);
  EXPECT_EQ(rename("of dora", once).exit_code, 0) << "sent again";
  EXPECT_EQ(rename("late", {"--expected-revision", "1"}).exit_code, 4);
  EXPECT_EQ(rename("late", {"--etag", "0123456789abcdef-r1"}).exit_code, 4);
  EXPECT_EQ(Run({"undo", "room", "--author", "dora"}).exit_code, 0);
  EXPECT_NE(Run({"undo", "room", "--author", "dora"}).exit_code, 0) << "made once";
  EXPECT_EQ(Run({"maps", "show", "room"}).out.find("of dora"), std::string::npos);
}

TEST_F(CommandLine, ExportsMeshesAndVoxels) {
  EXPECT_EQ(Run({"export", "ply", "room", "-o", File("room.ply").string(), "--color", "instance"}).exit_code, 0);
  EXPECT_TRUE(FileBytes(File("room.ply")).starts_with("ply\n"));
  EXPECT_EQ(Run({"export", "pcd", "room", "1", "-o", File("one.pcd").string()}).exit_code, 0);
  EXPECT_NE(FileBytes(File("one.pcd")).find("DATA binary"), std::string::npos);
  const Outcome voxels = Run({"export", "voxels", "room", "1", "-o", "-"});
  EXPECT_TRUE(voxels.out.starts_with("x_m,y_m,z_m,tsdf_m")) << voxels.out.substr(0, 80);
  EXPECT_GT(std::count(voxels.out.begin(), voxels.out.end(), '\n'), 100);
  EXPECT_EQ(Run({"export", "ply", "room", "999", "-o", File("none.ply").string()}).exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(File("none.ply")));
  EXPECT_EQ(Run({"export", "ply", "room", "-o", File("no/where.ply").string()}).exit_code, 7);
  EXPECT_EQ(Run({"export", "glb", "room", "-o", File("room.glb").string()}).exit_code, 0);
  EXPECT_TRUE(FileBytes(File("room.glb")).starts_with("glTF"));
}

TEST_F(CommandLine, ExportsAnOctoMapWithFreeCells) {
  const Outcome whole = Run({"export", "octomap", "room", "-o", File("room.bt").string(), "--json"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const auto count = [](const Outcome& told, const char* what) {
    std::smatch found;
    return std::regex_search(told.out, found, std::regex(std::string("\"") + what + "\": (\\d+)")) ? std::stol(found[1])
                                                                                                   : -1;
  };
  EXPECT_GT(count(whole, "occupied"), 100) << whole.out;
  EXPECT_GT(count(whole, "cells"), 2 * count(whole, "occupied")) << "most of a room is free";
  EXPECT_TRUE(FileBytes(File("room.bt")).starts_with("# Octomap OcTree binary file\nid OcTree\nsize "));
  const Outcome band = Run({"export", "octomap", "room", "-o", File("band.bt").string(), "--heights", "0.5", "0.6",
                            "--resolution", "0.1", "--json"});
  EXPECT_GT(count(band, "cells"), 0) << band.out;
  EXPECT_LT(count(band, "cells"), count(whole, "cells") / 10);
  EXPECT_EQ(Run({"export", "octomap", "nowhere", "-o", File("none.bt").string()}).exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(File("none.bt")));
}

TEST_F(CommandLine, ABackupIsADatabaseThatAServerStartsOn) {
  SKIP_ON_POSTGRES("pg_dump makes backups");
  ASSERT_EQ(Run({"backup", File("copy.db").string()}).exit_code, 0);
  EXPECT_EQ(Run({"backup", File("copy.db").string()}).exit_code, 1) << "not over a file that is there";
  EXPECT_EQ(Run({"backup", File("copy.db").string(), "--force"}).exit_code, 0);
  const std::string url = server_->http_url() + "/v1/maps:backup";
  const Outcome fetched = RunProgram(temp_->path(), {"curl", "-sf", "-o", File("fetched.db").string(), url});
  EXPECT_EQ(fetched.exit_code, 0) << fetched.err;
  EXPECT_EQ(std::filesystem::file_size(File("fetched.db")), std::filesystem::file_size(File("copy.db")));
  ServerProcess other(File(""), File("copy.db"));
  ASSERT_TRUE(other.is_serving()) << other.process().Stderr();
  EXPECT_NE(other.Dhpmap({"submaps", "room"}).out.find("Ball"), std::string::npos);
  EXPECT_EQ(other.Terminate(), 0);
}

TEST_F(CommandLine, WhatIsStoredOfAMapIsVerifiedThroughBothDoors) {
  const Outcome verified = Run({"verify", "room"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  EXPECT_NE(verified.out.find("all of it is whole"), std::string::npos) << verified.out;
  EXPECT_EQ(Run({"verify", "nowhere"}).exit_code, 3);
  const std::string url = server_->http_url() + "/v1/maps/room:verify";
  const Outcome posted = RunProgram(temp_->path(), {"curl", "-sf", "-d", "{}", url});
  EXPECT_EQ(posted.exit_code, 0) << posted.err;
  EXPECT_NE(posted.out.find("\"num_tiles\""), std::string::npos) << posted.out;
}

TEST_F(CommandLine, AMapIsRenamed) {
  EXPECT_EQ(Run({"maps", "rename", "room", "Grandmother's kitchen"}).exit_code, 0);
  EXPECT_NE(Run({"maps"}).out.find("Grandmother's kitchen"), std::string::npos);
  EXPECT_EQ(Run({"maps", "rename", "nowhere", "x"}).exit_code, 3);
}

TEST_F(CommandLine, ExitCodesTellErrorsApart) {
  EXPECT_EQ(Run({}).exit_code, 1);
  EXPECT_EQ(Run({"fly"}).exit_code, 1);
  EXPECT_EQ(Run({"query", "point", "room", "1", "2"}).exit_code, 1);
  EXPECT_EQ(Run({"maps", "create", "other", "--set", "nothing=1"}).exit_code, 1);
  EXPECT_EQ(Run({"maps", "create", "other", "--set", "voxel_size_m=-1"}).exit_code, 2);
  EXPECT_EQ(Run({"maps", "create", "room"}).exit_code, 4);
  EXPECT_EQ(Run({"submaps", "nowhere"}).exit_code, 3);
  EXPECT_EQ(Run({"map", File("nowhere").string(), "--map", "x"}).exit_code, 7);
  EXPECT_EQ(Run({"map", File("dataset").string(), "--map", "room", "--labels", "predicted"}).exit_code, 2)
      << "other classes";
  const Outcome unreachable = RunProgram(temp_->path(), {Program("dhpmap"), "maps", "--server", "127.0.0.1:1"});
  EXPECT_EQ(unreachable.exit_code, 5);
  EXPECT_NE(unreachable.err.find("UNAVAILABLE"), std::string::npos) << unreachable.err;
  EXPECT_NE(unreachable.err.find("Is dhpmap-server running"), std::string::npos) << unreachable.err;
}

/// A complete database, with no server on it.
std::string SettledDatabase(const std::filesystem::path& folder) {
  const std::filesystem::path db = folder / "settled.db";
  ServerProcess server(folder, db);
  EXPECT_EQ(server.Dhpmap({"map", (folder / "dataset").string(), "--map", "room"}).exit_code, 0);
  EXPECT_EQ(server.Terminate(), 0);
  return FileBytes(db);
}

TEST_F(CommandLine, AServerThatCannotUseItsDatabaseSaysWhyAndLeavesItAlone) {
  SKIP_ON_POSTGRES("there is no file to damage");
  const std::string good = SettledDatabase(temp_->path());
  ASSERT_GT(good.size(), 10'000u);
  std::string foreign = good, newer = good;
  foreign[68] = static_cast<char>(foreign[68] ^ 0x55);  // application_id
  newer[60] = 1;                                        // user_version
  struct Case {
    const char* name;
    std::string content, code;
  };
  for (const Case& bad :
       {Case{"notes.txt", "These are notes. " + std::string(2000, 'x'), "FAILED_PRECONDITION|DATA_LOSS"},
        Case{"cut.db", good.substr(0, good.size() / 2), "DATA_LOSS"},
        Case{"foreign.db", foreign, "FAILED_PRECONDITION"}, Case{"newer.db", newer, "FAILED_PRECONDITION"}}) {
    SCOPED_TRACE(bad.name);
    std::ofstream(File(bad.name), std::ios::binary) << bad.content;
    ServerProcess server(temp_->path(), File(bad.name));
    EXPECT_FALSE(server.is_serving());
    ASSERT_EQ(server.process().Wait(), 1) << "an error, not a crash: " << server.process().Stderr();
    const std::string said = server.process().Stderr();
    EXPECT_TRUE(std::regex_search(said, std::regex(bad.code))) << said;
    EXPECT_EQ(FileBytes(File(bad.name)), bad.content);
  }
  ServerProcess no_folder(temp_->path(), File("no/such/folder/maps.db"));
  EXPECT_FALSE(no_folder.is_serving());
  EXPECT_EQ(no_folder.process().Wait(), 1);
  EXPECT_FALSE(no_folder.process().Stderr().empty());
}

TEST_F(CommandLine, TwoServersDoNotShareADatabase) {
  SKIP_ON_POSTGRES("servers do share a database");
  ServerProcess second(temp_->path(), temp_->path() / "maps.db");
  EXPECT_FALSE(second.is_serving());
  EXPECT_EQ(second.process().Wait(), 1);
  EXPECT_EQ(Run({"maps"}).exit_code, 0) << "the first one goes on";
}

}  // namespace
}  // namespace dhpmap::testing
