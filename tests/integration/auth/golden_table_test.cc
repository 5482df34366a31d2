// SPDX-License-Identifier: BSD-3-Clause
// Every rpc, called by every role over both doors, is answered as tests/unit/server/auth/permissions.txt says.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "server/gateway/http_rule_router.h"
#include "tests/integration/auth/locked_server.h"
#include "tests/support/places.h"

namespace dhpmap::testing {
namespace {

struct Row {
  std::string path, need;
  std::map<std::string, std::string> right_of;  ///< yes, no, try or all, by role
};

std::vector<Row> Rows() {
  std::ifstream file(SourceDir() / "tests/unit/server/auth/permissions.txt");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    Row row;
    std::istringstream words(line);
    words >> row.path >> row.need;
    row.path.pop_back();  // its colon
    for (const char* role : {"viewer", "editor", "robot", "admin"}) words >> row.right_of[role];
    rows.push_back(row);
  }
  return rows;
}

/// A health watch does not end; it is admitted or refused before it begins.
bool NeverEnds(const Row& row) { return row.path == "/grpc.health.v1.Health/Watch"; }

TEST(GoldenTable, HoldsAtTheGrpcDoor) {
  LockedServer locked;
  const auto rows = Rows();
  ASSERT_GE(rows.size(), 45u);
  for (const Row& row : rows) {
    const bool is_public = row.right_of.at("viewer") == "all";
    const auto without = CallRawAs(locked.server().channel(), row.path, "").error_code();
    EXPECT_EQ(without == grpc::UNAUTHENTICATED, !is_public) << row.path << " without a key: " << without;
    for (const auto& [role, right] : row.right_of) {
      const bool is_let_in = right == "yes" || right == "all";
      if (is_let_in && NeverEnds(row)) continue;
      // The message is empty, so it does not ask for a trial.
      const grpc::Status status = CallRawAs(locked.server().channel(), row.path, locked.key_of(role));
      EXPECT_EQ(status.error_code() == grpc::PERMISSION_DENIED, !is_let_in)
          << row.path << " by " << role << ": " << status.error_code() << " " << status.error_message();
      EXPECT_NE(status.error_code(), grpc::UNAUTHENTICATED) << row.path;
      EXPECT_NE(status.error_code(), grpc::UNIMPLEMENTED) << row.path;
    }
  }
}

TEST(GoldenTable, HoldsAtTheRestDoor) {
  LockedServer locked;
  std::map<std::string, Row> rows;
  for (const Row& row : Rows()) rows[row.path] = row;
  const auto router = gateway::HttpRuleRouter::FromLinkedServices();
  ASSERT_TRUE(router.ok());
  std::set<std::string> met;
  for (const gateway::Route& route : router->routes()) {
    met.insert(route.rpc_path);
    std::string target =
        std::regex_replace(route.path.text(), std::regex("\\{[a-z_.]+=maps/\\*/submaps/\\*\\}"), "maps/none/submaps/1");
    target = std::regex_replace(target, std::regex("\\{[a-z_.]+=maps/\\*\\}"), "maps/none");
    ASSERT_EQ(target.find('{'), std::string::npos) << target;
    const std::string body = route.http_method == "GET" || route.http_method == "DELETE" ? "" : "{}";
    EXPECT_EQ(locked.Ask("", route.http_method, target, body).status, 401) << target;
    for (const auto& [role, right] : rows.at(route.rpc_path).right_of) {
      const int status = locked.Ask(locked.key_of(role), route.http_method, target, body).status;
      EXPECT_EQ(status == 403, right != "yes")
          << route.http_method << " " << target << " by " << role << ": " << status;
      EXPECT_NE(status, 401) << target;
    }
  }
  for (const auto& [path, row] : rows) EXPECT_TRUE(met.contains(path) || path.starts_with("/grpc.")) << path;
}

}  // namespace
}  // namespace dhpmap::testing
