// SPDX-License-Identifier: BSD-3-Clause
// Keys in a PostgreSQL database: the programs that make them, and the servers that take them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/e2e/server_process.h"
#include "tests/support/eventually.h"
#include "tests/support/postgres_cluster.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

class KeysInADatabase : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    url_ = PostgresCluster::Get()->NewDatabase();
  }
  Outcome Dhpmap(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), Program("dhpmap"));
    return RunProgram(folder_.path(), std::move(arguments));
  }
  /// The file of a new key.
  std::string MakeKey(const std::string& name, const std::string& role) {
    const Outcome made = Dhpmap({"keys", "create", name, "--role", role, "--db", url_});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const std::string file = (folder_.path() / name).string();
    std::ofstream(file) << made.out;
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    return file;
  }
  Outcome StartInVain(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {Program("dhpmap-server"), "--db", url_, "--http", "127.0.0.1:0"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return RunProgram(folder_.path(), std::move(all));
  }

  TempDir folder_;
  std::string url_;
};

TEST_F(KeysInADatabase, TwoServersTakeANewKeyAndRefuseARevokedOneWhileTheyRun) {
  const std::string admin = MakeKey("anna", "admin");
  ServerProcess one(folder_.path(), url_), other(folder_.path(), url_);
  ASSERT_TRUE(one.is_serving() && other.is_serving()) << one.process().Stderr();
  const std::string viewer = MakeKey("vic", "viewer");
  const auto says = [&](const ServerProcess& server, const std::string& text) {
    return Eventually([&] {
      const Outcome asked = server.Dhpmap({"--token-file", viewer, "whoami"});
      return (asked.out + asked.err).find(text) != std::string::npos;
    });
  };
  for (const ServerProcess* server : {&one, &other}) EXPECT_TRUE(says(*server, "vic, a viewer"));
  EXPECT_NE(one.Dhpmap({"maps", "list"}).err.find("NO_CREDENTIAL"), std::string::npos);
  EXPECT_EQ(one.Dhpmap({"--token-file", admin, "maps", "create", "hall"}).exit_code, 0);
  EXPECT_EQ(Dhpmap({"keys", "revoke", "vic", "--db", url_}).exit_code, 0);
  for (const ServerProcess* server : {&one, &other}) EXPECT_TRUE(says(*server, "KEY_REVOKED"));
  EXPECT_EQ(one.Terminate(), 0);
  EXPECT_EQ(other.Terminate(), 0);
  const std::string log = Dhpmap({"audit", "--db", url_, "--principal", "anna"}).out;
  EXPECT_NE(log.find("CreateMap  hall  allowed"), std::string::npos) << log;
  const std::string all = Dhpmap({"audit", "--db", url_, "--json"}).out;
  EXPECT_NE(all.find("KEY_REVOKED"), std::string::npos) << all;
  EXPECT_EQ(all.find("dhp_"), std::string::npos) << all;
}

TEST_F(KeysInADatabase, AnExposedServerWithoutAKeyIsRefused) {
  const Outcome without = StartInVain({"--grpc", "0.0.0.0:0", "--insecure-no-tls"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("no keys"), std::string::npos) << without.err;
}

TEST_F(KeysInADatabase, AServerWhoseOnlyKeyIsRevokedStaysLocked) {
  (void)MakeKey("anna", "admin");
  EXPECT_EQ(Dhpmap({"keys", "revoke", "anna", "--db", url_}).exit_code, 0);
  const ServerProcess server(folder_.path(), url_);
  ASSERT_TRUE(server.is_serving());
  EXPECT_NE(server.Dhpmap({"maps", "list"}).err.find("NO_CREDENTIAL"), std::string::npos);
}

TEST_F(KeysInADatabase, AServerWithKeysInAFileAndInTheDatabaseIsRefused) {
  (void)MakeKey("anna", "admin");
  const std::string file = (folder_.path() / "keys").string();
  EXPECT_EQ(Dhpmap({"keys", "create", "bert", "--keys", file}).exit_code, 0);
  const Outcome started = StartInVain({"--grpc", "127.0.0.1:0", "--set", "auth.keys=" + file});
  EXPECT_EQ(started.exit_code, 2);
  EXPECT_NE(started.err.find("auth.keys"), std::string::npos) << started.err;
}

TEST_F(KeysInADatabase, KeysAreListedAndRotatedAsInAFile) {
  (void)MakeKey("anna", "admin");
  EXPECT_EQ(Dhpmap({"keys", "rotate", "anna", "--overlap", "1h", "--db", url_}).exit_code, 0);
  const std::string list = Dhpmap({"--json", "keys", "list", "--db", url_}).out;
  EXPECT_EQ(list.find("sha256"), std::string::npos);
  EXPECT_NE(list.find("anna", list.find("anna") + 1), std::string::npos) << list;
  EXPECT_EQ(Dhpmap({"keys", "revoke", "nobody", "--db", url_}).exit_code, 1);
  EXPECT_EQ(Dhpmap({"keys", "list", "--db", "postgresql:///x?host=/nowhere"}).exit_code, 5);
}

}  // namespace
}  // namespace dhpmap::testing
