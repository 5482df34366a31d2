// SPDX-License-Identifier: BSD-3-Clause
// deploy/debian and deploy/monitoring as they read; deploy/try_packages.sh installs them.
#include "tests/unit/deploy/script_fixture.h"

namespace dhpmap {
namespace {

class PackagesTest : public ScriptTest {};

TEST_F(PackagesTest, TheUnitLeavesNoMoreOpenThanItNeeds) {
  if (Shell("systemd-analyze --version").exit_code != 0) GTEST_SKIP() << "without systemd-analyze: install systemd";
  const Run run =
      Shell("systemd-analyze security --offline=true --threshold=15 " + Script("debian/dhpmap-server.service"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
}

TEST_F(PackagesTest, TheUnitAllowsWhatThreadsThatMayWaitAskTheSystemFor) {
  // mapping/base/this_thread.cc; whoever takes @resources away takes these two with it.
  const Run run = Shell("grep -nE '^SystemCallFilter=' " + Script("debian/dhpmap-server.service"));
  const auto denied = run.output.find("SystemCallFilter=~");
  const auto allowed = run.output.find("SystemCallFilter=sched_setattr setpriority\n");
  ASSERT_NE(denied, std::string::npos) << run.output;
  ASSERT_NE(allowed, std::string::npos) << run.output;
  EXPECT_LT(denied, allowed) << "the last word on a system call is the one that counts";
}

TEST_F(PackagesTest, SocketsHaveTheNamesByWhichTheServerKnowsThem) {
  for (const std::string name : {"grpc", "rest"}) {
    const Run run = Shell("cat " + Script("debian/dhpmap-server.dhpmap-" + name + ".socket"));
    EXPECT_TRUE(run.Says("FileDescriptorName=" + name + "\n")) << run.output;
    EXPECT_TRUE(run.Says("Service=dhpmap-server.service\n")) << run.output;
  }
}

TEST_F(PackagesTest, WhatTheBuildNeedsIsWhatSetupInstalls) {
  // Each -dev package of deploy/setup.sh but those of tests is in Build-Depends.
  const Run run =
      Shell("sed -n '/^packages=(/,/^)/p' " + Script("setup.sh") +
            " | grep -oE '[a-z0-9+.-]+-dev' | grep -vxE 'libgtest-dev|liboctomap-dev' | while read -r package; do"
            " tr ', ' '\\n\\n' <" +
            Script("debian/control") + " | grep -qxF -- $package || echo \"missing: $package\"; done");
  EXPECT_EQ(run.output, "");
}

TEST_F(PackagesTest, WhoPurgesIsAskedAndKeepsTheMapsUnlessTheAnswerIsYes) {
  WriteFile("confmodule",
            "db_version() { :; }\ndb_input() { echo asked; }\ndb_go() { :; }\ndb_get() { RET=$ANSWER; }\n");
  for (const auto& [answer, is_kept] : {std::pair{"false", true}, {"true", false}}) {
    WriteFile("lib/maps.db", "maps");
    const Run run = Shell(
        "sed -e 's#/usr/share/debconf#'$PWD'#g' -e 's#/var/lib/dhpmap#'$PWD'/lib#g' -e "
        "'s#/var/log/dhpmap#'$PWD'/log#g' " +
        Script("debian/dhpmap-server.postrm") + " >postrm && ANSWER=" + answer + " sh postrm purge");
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_TRUE(run.Says("asked")) << run.output;
    EXPECT_EQ(std::filesystem::exists(Folder() / "lib/maps.db"), is_kept) << answer;
  }
  WriteFile("lib/maps.db", "maps");
  EXPECT_EQ(Shell("ANSWER=true sh postrm remove").output, "");
  EXPECT_TRUE(std::filesystem::exists(Folder() / "lib/maps.db")) << "removing deletes nothing";
}

}  // namespace
}  // namespace dhpmap
