// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/notifier.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/fake_manager.h"
#include "tests/support/scenes.h"

namespace dhpmap::service {
namespace {

using testing::FakeManager;

TEST(Notifier, SendsTheMessagesOfSdNotify) {
  const testing::TempDir folder;
  FakeManager manager((folder.path() / "notify").string());
  ASSERT_TRUE(manager.is_open());
  const Notifier notifier(manager.name());
  EXPECT_TRUE(notifier.is_heard());
  notifier.TellStarting("1 of 2\nREADY=1");
  EXPECT_EQ(manager.Next(), "STATUS=1 of 2 READY=1\nEXTEND_TIMEOUT_USEC=600000000") << "a status is one line";
  notifier.TellReady("gRPC on x");
  EXPECT_EQ(manager.Next(), "READY=1\nSTATUS=gRPC on x");
  notifier.TellAlive();
  EXPECT_EQ(manager.Next(), "WATCHDOG=1");
  notifier.TellReloading();
  EXPECT_TRUE(std::regex_match(manager.Next(), std::regex("RELOADING=1\nMONOTONIC_USEC=[1-9][0-9]*\nSTATUS=.+")));
  notifier.TellStopping("storing");
  EXPECT_EQ(manager.Next(), "STOPPING=1\nSTATUS=storing\nEXTEND_TIMEOUT_USEC=600000000");
}

TEST(Notifier, ReachesAnAbstractName) {
  FakeManager manager("@dhpmap-notifier-test-" + std::to_string(::getpid()));
  ASSERT_TRUE(manager.is_open());
  Notifier(manager.name()).TellAlive();
  EXPECT_EQ(manager.Next(), "WATCHDOG=1");
}

TEST(Notifier, WorksWithoutAManager) {
  const testing::TempDir folder;
  const std::string none = (folder.path() / "none").string();
  for (const std::string& socket : {std::string(), none, std::string(200, 'x')}) {
    const Notifier notifier(socket);
    EXPECT_FALSE(notifier.is_heard());
    notifier.TellReady("nobody hears it");
  }
  const std::string place = (folder.path() / "notify").string();
  auto manager = std::make_unique<FakeManager>(place);
  const Notifier notifier(place);
  manager = nullptr;
  notifier.TellReady("it has gone");
}

TEST(Notifier, FindsAVariableByItsFullName) {
  const std::vector<std::string> environment = {"NOTIFY_SOCKET_OLD=/a", "XNOTIFY_SOCKET=/b", "NOTIFY_SOCKET=/c=d",
                                                "EMPTY=", "NONE"};
  EXPECT_EQ(ValueIn(environment, "NOTIFY_SOCKET"), "/c=d");
  for (const char* name : {"EMPTY", "NONE", "NOTIFY", ""}) EXPECT_EQ(ValueIn(environment, name), "") << name;
}

}  // namespace
}  // namespace dhpmap::service
