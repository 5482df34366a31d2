// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/audit_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
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

TEST_F(AuditLogTest, ALineNamesCallerAndAction) {
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

TEST_F(AuditLogTest, AFloodOfRefusalsIsSummarisedAndHidesNothingElse) {
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

TEST_F(AuditLogTest, ContinuesInANewFileAfterARename) {
  const auto log = Open();
  EXPECT_TRUE(log->Write({.principal = &anna, .rpc = "/before"}).ok());
  const std::filesystem::path old = folder.path() / "audit.jsonl.1";
  std::filesystem::rename(path, old);
  EXPECT_TRUE(log->Write({.principal = &anna, .rpc = "/between"}).ok());
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(log->Reopen().ok());
  EXPECT_TRUE(log->Write({.principal = &anna, .rpc = "/after"}).ok());
  ASSERT_EQ(Lines().size(), 1u);
  EXPECT_NE(Lines()[0].find("/after"), std::string::npos);
  std::ifstream file(old);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST_F(AuditLogTest, ContinuesInTheOldFileIfTheNewOneCannotBeOpened) {
  const auto log = Open();
  const std::filesystem::path old = folder.path() / "audit.jsonl.1";
  std::filesystem::rename(path, old);
  std::filesystem::create_symlink(folder.path() / "elsewhere", path);
  EXPECT_EQ(log->Reopen().reason(), Reason("BAD_KEY_FILE"));
  EXPECT_TRUE(log->Write({.principal = &anna, .rpc = "/x"}).ok());
  EXPECT_GT(std::filesystem::file_size(old), 0u);
}

TEST(AuditLog, ReportsThatItCannotBeWritten) {
  const auto log = AuditLog::Open("/dev/full", SystemWallClock());
  ASSERT_TRUE(log.ok()) << log.status().ToString();
  const Status written = (*log)->Write({.rpc = "/x"});
  EXPECT_EQ(written.code(), StatusCode::kUnavailable);
  EXPECT_EQ(written.reason(), Reason("NOT_STORED"));
}

TEST_F(AuditLogTest, LinksAreRefused) {
  std::filesystem::create_symlink(folder.path() / "elsewhere", path);
  EXPECT_FALSE(AuditLog::Open(path, SystemWallClock()).ok());
}

}  // namespace
}  // namespace dhpmap::auth
