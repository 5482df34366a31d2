// SPDX-License-Identifier: BSD-3-Clause
// Two clients feed one map of a server that records, and what it recorded is fed again: real processes, commands, curl.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/same_maps.h"
#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

class Replay : public ::testing::Test {
 protected:
  Replay() {
    setenv("DHPMAP_MAPPING_RECORD_DIR", records().c_str(), 1);
    setenv("DHPMAP_MAPPING_REPRODUCIBLE", "true", 1);
    WriteRenderedDataset(dataset(), kNumFrames);
  }
  ~Replay() override {
    unsetenv("DHPMAP_MAPPING_RECORD_DIR");
    unsetenv("DHPMAP_MAPPING_REPRODUCIBLE");
  }

  static constexpr int kNumFrames = 24;
  [[nodiscard]] std::filesystem::path root() const { return temp_.path(); }
  [[nodiscard]] std::filesystem::path dataset() const { return root() / "dataset"; }
  [[nodiscard]] std::filesystem::path records() const { return root() / "records"; }
  [[nodiscard]] std::string OnlyRecord() const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(records())) files.push_back(entry.path());
    EXPECT_EQ(files.size(), 1u);
    return files.at(0);
  }

 private:
  TempDir temp_;
};

TEST_F(Replay, WhatTwoFedTogetherIsMadeAgainFromTheRecord) {
  std::string record;
  {
    ServerProcess server(root(), root() / "maps.db");
    ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
    ASSERT_EQ(server.Dhpmap({"maps", "create", "room", "--dataset", dataset().string()}).exit_code, 0);
    const auto feed = [&](const char* start, const char* session) {
      return std::vector<std::string>{Program("dhpmap"),
                                      "--server",
                                      server.grpc_address(),
                                      "map",
                                      dataset().string(),
                                      "--map",
                                      "room",
                                      "--start",
                                      start,
                                      "--every",
                                      "2",
                                      "--session",
                                      session,
                                      "--no-finish"};
    };
    Process a(root(), feed("0", "a")), b(root(), feed("1", "b"));
    EXPECT_EQ(a.Wait(), 0) << a.Stderr();
    EXPECT_EQ(b.Wait(), 0) << b.Stderr();
    EXPECT_EQ(GetMap(server, "room").num_frames(), kNumFrames);
    ASSERT_EQ(server.Dhpmap({"finish", "room"}).exit_code, 0);

    const Outcome list = server.Dhpmap({"sessions", "list", "room"});
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_NE(list.out.find("\na "), std::string::npos) << list.out;
    const Outcome over_http = RunProgram(root(), {"curl", "-sf", server.http_url() + "/v1/maps/room/sessions"});
    EXPECT_EQ(over_http.exit_code, 0);
    EXPECT_NE(over_http.out.find("\"committed_sequence\":\"23\""), std::string::npos) << over_http.out;
    EXPECT_EQ(server.Dhpmap({"sessions", "end", "room", "a"}).exit_code, 3) << "it has ended by itself";
    const Outcome ended =
        RunProgram(root(), {"curl", "-s", "-d", R"({"session": "b"})", server.http_url() + "/v1/maps/room:endSession"});
    EXPECT_NE(ended.out.find("SESSION_NOT_FOUND"), std::string::npos) << ended.out;

    record = OnlyRecord();
    const Outcome replay = server.Dhpmap({"replay", record, "--map", "again"});
    EXPECT_EQ(replay.exit_code, 0) << replay.out << replay.err;
    EXPECT_NE(replay.out.find("replayed 24 frames of 2 sessions into maps/again, finished 1 times"), std::string::npos)
        << replay.out;
    ExpectSameMaps(server, "room", "again");
    EXPECT_EQ(server.Dhpmap({"replay", record, "--map", "again"}).exit_code, 4) << "the map is there";
    EXPECT_EQ(server.Dhpmap({"replay", root() / "nowhere", "--map", "other"}).exit_code, 7);
    EXPECT_EQ(server.Dhpmap({"replay", record, "--map", "bad", "--set", "nothing=1"}).exit_code, 1);
    EXPECT_EQ(server.Terminate(), 0);
  }
  // A record that was cut off, with other settings, into a server of its own.
  std::filesystem::resize_file(record, std::filesystem::file_size(record) / 2);
  ServerProcess other(root(), root() / "other.db");
  ASSERT_TRUE(other.is_serving());
  const Outcome replay = other.Dhpmap(
      {"replay", record, "--map", "coarse", "--set", "voxel_size_m=0.1", "--set", "truncation_m=0.2", "--json"});
  EXPECT_EQ(replay.exit_code, 0) << replay.out << replay.err;
  EXPECT_NE(replay.out.find("\"torn\": true"), std::string::npos) << replay.out;
  const v1::Map coarse = GetMap(other, "coarse");
  EXPECT_EQ(coarse.config().voxel_size_m(), 0.1);
  EXPECT_GT(coarse.num_frames(), 0);
  EXPECT_LT(coarse.num_frames(), kNumFrames);
}

}  // namespace
}  // namespace dhpmap::testing
