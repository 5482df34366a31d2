// SPDX-License-Identifier: BSD-3-Clause
// What a service manager hears of a server: when it can be asked, that it is alive, what it reads again, its end.
#include <csignal>

#include "tests/e2e/service/service_fixture.h"

namespace dhpmap::testing {
namespace {

class Notify : public ServiceTest {};

TEST_F(Notify, ReadyIsToldOnceBothDoorsAnswer) {
  Start();
  const std::string ready = manager_.NextThatBegins("READY=1");
  ASSERT_NE(ready, "") << server_->Stderr();
  const Outcome asked = Curl(RestUrlIn(ready) + "/readyz");
  EXPECT_NE(asked.out.find("200"), std::string::npos) << asked.out << asked.err;
  EXPECT_NE(ready.find("STATUS=gRPC on 127.0.0.1:"), std::string::npos) << ready;
  server_->Signal(SIGTERM);
  EXPECT_TRUE(manager_.Next().starts_with("STOPPING=1\nSTATUS="));
  EXPECT_EQ(server_->Wait(), 0);
}

TEST_F(Notify, WhyThereIsNoStartIsTold) {
  Write("maps.db", "this is no database");
  Start();
  const std::string told = manager_.Next();
  EXPECT_TRUE(told.starts_with("STOPPING=1\nSTATUS=DATA_LOSS")) << told;
  EXPECT_EQ(server_->Wait(), 1);
}

TEST_F(Notify, TheWatchdogIsFedThriceInItsTime) {
  Start({}, {{"WATCHDOG_USEC", "30000"}});
  ASSERT_NE(manager_.NextThatBegins("READY=1"), "") << server_->Stderr();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(manager_.Next(), "WATCHDOG=1");
  EndServer();
}

TEST_F(Notify, HangUpReadsSettingsAgainAndEndsNothing) {
  Write("dhpmap.yaml", "log:\n  level: info\n");
  Start({"--config", File("dhpmap.yaml").string()});
  const std::string ready = manager_.NextThatBegins("READY=1");
  ASSERT_NE(ready, "") << server_->Stderr();

  Write("dhpmap.yaml", "log:\n  level: warning\nstore:\n  commit_s: 3\n");
  server_->Signal(SIGHUP);
  EXPECT_TRUE(manager_.Next().starts_with("RELOADING=1\nMONOTONIC_USEC="));
  EXPECT_EQ(manager_.Next(), ready);
  EXPECT_NE(server_->Stderr().find("wait for a restart: store.commit_s\n"), std::string::npos) << server_->Stderr();

  Write("dhpmap.yaml", "log:\n  level: loud\n");
  server_->Signal(SIGHUP);
  EXPECT_TRUE(manager_.Next().starts_with("RELOADING=1"));
  EXPECT_EQ(manager_.Next(), ready) << "and goes on with what it had";
  EXPECT_NE(server_->Stderr().find("settings stay as they are"), std::string::npos) << server_->Stderr();
  EXPECT_NE(Curl(RestUrlIn(ready) + "/readyz").out.find("200"), std::string::npos);
  EndServer();
  EXPECT_EQ(server_->Stderr().find("got signal"), std::string::npos) << "an info, and the level is warning now";
}

TEST_F(Notify, LinesOfTheLogAreAsTheJournalWantsThem) {
  const std::string script =
      "exec 2>\"$0.log\"; JOURNAL_STREAM=$(stat -L -c %d:%i /proc/self/fd/2); export JOURNAL_STREAM; exec \"$@\"";
  server_ = std::make_unique<Process>(
      folder_.path(), std::vector<std::string>{"/bin/bash", "-c", script, File("journal").string(),
                                               Program("dhpmap-server"), "--db", (File("none") / "maps.db").string()});
  EXPECT_EQ(server_->Wait(), 1);
  std::ifstream log(File("journal.log"));
  std::string line;
  ASSERT_TRUE(std::getline(log, line));
  EXPECT_TRUE(line.starts_with("<3>NOT_FOUND: ")) << line;
}

TEST_F(Notify, AnUpgradeIsToldAndLeavesTheDatabaseAsItWasBesideIt) {
  const auto released = SourceDir() / "tests/unit/storage/released/schema-12.sqlite";
  std::filesystem::copy_file(released, File("maps.db"));
  std::filesystem::permissions(File("maps.db"), std::filesystem::perms::owner_write,
                               std::filesystem::perm_options::add);
  Start();
  const std::string first = manager_.Next();
  EXPECT_NE(first.find("from schema 12 to "), std::string::npos) << first;
  EXPECT_NE(first.find("EXTEND_TIMEOUT_USEC="), std::string::npos) << first;
  EXPECT_NE(manager_.NextThatBegins("READY=1"), "");
  EndServer();
  std::set<std::string> copies;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("maps.db.before-v")) copies.insert(name);
  }
  EXPECT_EQ(copies.size(), 1u);
}

}  // namespace
}  // namespace dhpmap::testing
