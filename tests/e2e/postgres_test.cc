// SPDX-License-Identifier: BSD-3-Clause
// The server on a PostgreSQL database.
#include <gtest/gtest.h>
#include <signal.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/server_process.h"
#include "tests/support/postgres_cluster.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

class ServerOnPostgres : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    WriteRenderedDataset(temp_.path() / "dataset", 6);
    Start();
  }
  void Start() {
    server_.emplace(temp_.path(), PostgresCluster::Get()->Url());
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
  }
  std::string Run(std::vector<std::string> arguments) {
    const Outcome outcome = server_->Dhpmap(std::move(arguments));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  }
  std::string Get(const std::string& path) {
    return RunProgram(temp_.path(), {"curl", "-sf", server_->http_url() + "/v1/maps/room" + path}).out;
  }
  /// Of the map, its objects, what was edited, and what is where.
  std::vector<std::string> Answers() {
    const std::string points = R"({"points_m":[{"x":0,"y":0,"z":0},{"x":0.4,"y":0.1,"z":0.2},{"x":1,"y":1,"z":1}]})";
    const std::string url = server_->http_url() + "/v1/maps/room:queryPoints";
    return {Run({"submaps", "room"}), Get("/submaps"), Get("/edits"),
            RunProgram(temp_.path(), {"curl", "-s", url, "-d", points}).out};
  }

  TempDir temp_;
  std::optional<ServerProcess> server_;
};

TEST_F(ServerOnPostgres, FramesAndEditsSurviveAStopAndAKill) {
  Run({"map", (temp_.path() / "dataset").string(), "--map", "room", "--labels", "groundtruth"});
  Run({"edit", "rename", "room", "1", "named on PostgreSQL"});
  const std::vector<std::string> before = Answers();
  EXPECT_NE(before[1].find("named on PostgreSQL"), std::string::npos) << before[1];
  EXPECT_NE(before[3].find("near_surface"), std::string::npos) << before[3];
  ASSERT_EQ(server_->Terminate(), 0);
  Start();
  EXPECT_EQ(Answers(), before);
  Run({"undo", "room"});
  const std::vector<std::string> undone = Answers();
  EXPECT_EQ(undone[1].find("named on PostgreSQL"), std::string::npos);
  server_->process().Signal(SIGKILL);
  ASSERT_TRUE(server_->process().Wait());
  Start();
  EXPECT_EQ(Answers(), undone);
}

}  // namespace
}  // namespace dhpmap::testing
