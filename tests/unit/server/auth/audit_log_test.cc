// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/audit_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace dhpmap::auth {
namespace {

class AuditLogTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> Lines() const {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  std::unique_ptr<AuditLog> Open() {
    auto log = AuditLog::Open(path, [this] { return now_s; });
    EXPECT_TRUE(log.ok()) << log.status().ToString();
    return *std::move(log);
  }

  testing::TempDir folder;
  const std::string path = (folder.path() / "audit.jsonl").string();
  std::int64_t now_s = 1'796'040'000;
  const Principal anna{.name = "anna", .key_id = "0123456789ab"};
};

TEST_F(AuditLogTest, ALineSaysWhoDidWhat) {
  EXPECT_TRUE(Open()->Write({.principal = &anna, .rpc = "/dhpmap.v1.MapService/DeleteMap", .map = "a"}).ok());
  const Status refused = Status(StatusCode::kUnauthenticated, "no").WithReason("NO_CREDENTIAL");
  EXPECT_TRUE(Open()->Write({.rpc = "/x", .map = "\xff\"\n", .decision = refused}).ok());
  EXPECT_EQ(Lines(), (std::vector<std::string>{
                         R"({"time":"2026-11-30T12:00:00Z","principal":"anna","key":"0123456789ab",)"
                         R"("rpc":"/dhpmap.v1.MapService/DeleteMap","map":"a","decision":"allowed"})",
                         "{\"time\":\"2026-11-30T12:00:00Z\",\"rpc\":\"/x\",\"map\":\"\xef\xbf\xbd\\\"\\n\","
                         "\"decision\":\"NO_CREDENTIAL\"}"}))
      << "behind what is there";
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST_F(AuditLogTest, AFloodOfRefusalsIsCountedAndHidesNothingElse) {
  const auto log = Open();
  const Status refused = Status(StatusCode::kUnauthenticated, "no").WithReason("NO_CREDENTIAL");
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(log->Write({.rpc = "/x", .decision = refused}).ok());
  EXPECT_EQ(Lines().size(), 10u);
  EXPECT_TRUE(log->Write({.principal = &anna, .rpc = "/y"}).ok());
  ASSERT_EQ(Lines().size(), 11u);
  EXPECT_NE(Lines()[10].find("\"refusals_left_out\":90"), std::string::npos);
  const std::string long_path(7000, 'x');
  EXPECT_TRUE(log->Write({.principal = &anna, .rpc = long_path, .decision = refused}).ok());
  ASSERT_EQ(Lines().size(), 12u) << "what strangers do hides no refusal of a known principal";
  EXPECT_LT(Lines()[11].size(), 300u);
  ++now_s;
  EXPECT_TRUE(log->Write({.rpc = "/x", .decision = refused}).ok());
  EXPECT_EQ(Lines().size(), 13u);
  EXPECT_EQ(Lines()[12].find("left_out"), std::string::npos);
}

TEST_F(AuditLogTest, LinksAreRefused) {
  std::filesystem::create_symlink(folder.path() / "elsewhere", path);
  EXPECT_FALSE(AuditLog::Open(path, SystemWallClock()).ok());
}

}  // namespace
}  // namespace dhpmap::auth
