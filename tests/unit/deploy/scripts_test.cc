// SPDX-License-Identifier: BSD-3-Clause
// .ci/run and deploy/setup.sh, with other steps and another apt than the real ones.
#include "tests/unit/deploy/script_fixture.h"

namespace dhpmap {
namespace {

class CiRunTest : public ScriptTest {
 protected:
  /// .ci/run of a tree in which steps.sh is what is done.
  [[nodiscard]] Run RunSteps(const std::string& steps) const {
    std::filesystem::create_directories(Folder() / ".ci");
    std::filesystem::copy_file(testing::SourceDir() / ".ci/run", Folder() / ".ci/run",
                               std::filesystem::copy_options::overwrite_existing);
    WriteFile("steps.sh", steps);
    return Shell("CI_STEPS=steps.sh .ci/run");
  }
};

TEST_F(CiRunTest, SumsUpWhatStepsCountAndCountsThoseThatDoNotAsOne) {
  const Run run = RunSteps("step echo '3 passed, 0 failed'\nstep true\n");
  EXPECT_EQ(run.LastLine(), "4 passed, 0 failed");
  EXPECT_EQ(run.exit_code, 0);
}

TEST_F(CiRunTest, AStepThatFailsIsAFailureWhateverItCounted) {
  const Run run = RunSteps("fails() { echo '3 passed, 0 failed'; return 1; }\nstep fails\nstep false\nstep true\n");
  EXPECT_EQ(run.LastLine(), "4 passed, 2 failed");
  EXPECT_EQ(run.exit_code, 1);
}

TEST_F(CiRunTest, FailuresThatAStepCountedAreNotCountedTwice) {
  const Run run = RunSteps("fails() { echo '3 passed, 2 failed'; return 1; }\nstep fails\n");
  EXPECT_EQ(run.LastLine(), "3 passed, 2 failed");
  EXPECT_EQ(run.exit_code, 1);
}

TEST_F(CiRunTest, SanitizersGetWhatIsLeftAtLeastTenMinutesAndNothingBeyondTheEnd) {
  const Run run = RunSteps(R"(for seconds in 300 1700 3600; do seconds_for_sanitizers $seconds; done)");
  EXPECT_TRUE(run.Says("1440\n600\n180\n")) << run.output;
}

TEST_F(CiRunTest, TellsWhatWasUnstable) {
  const Run run = RunSteps(
      R"(unsteady() { printf '1 unstable: failed, and passed by itself:\n  unit/a/A.One\n1 passed, 0 failed\n'; }
step unsteady)");
  EXPECT_TRUE(run.Says("unstable, to be cured:\n  unit/a/A.One\n1 passed, 0 failed")) << run.output;
}

TEST_F(CiRunTest, RepeatsAtItsEndWhatFailedAndWhy) {
  const Run run = RunSteps(
      "finds() { echo 'a.cc:1: error: x'; echo '-- tidy failed'; return 1; }\n"
      "step finds\nstep echo '1 passed, 0 failed'\n");
  EXPECT_TRUE(run.Says("-- failed: finds\na.cc:1: error: x\n-- tidy failed\n1 passed, 1 failed")) << run.output;
}

/// deploy/setup.sh where dpkg-query, apt-get, sudo and dpkg write down how they are called, and install the protos.
class SetupTest : public ScriptTest {
 protected:
  SetupTest() {
    std::filesystem::create_directories(Folder() / "deploy");
    std::filesystem::copy_file(Script("setup.sh"), Folder() / "deploy/setup.sh");
    WriteProgram("bin/dpkg-query", "#!/bin/sh\ncat installed 2>/dev/null | sed 's/^/installed /'\n");
    WriteProgram("bin/apt-get", R"sh(#!/bin/sh
echo "$1" >>"$CALLS"
if [ "$1" = download ]; then touch package.deb; fi
)sh");
    WriteProgram("bin/sudo", "#!/bin/sh\nshift\nexec \"$@\"\n");
    WriteProgram("bin/dpkg", R"sh(#!/bin/sh
for proto in api/annotations api/http rpc/code rpc/error_details rpc/status; do
  mkdir -p "$3/google/$(dirname $proto)"
  echo 'message ErrorInfo' >"$3/google/$proto.proto"
done
)sh");
  }
  [[nodiscard]] Run Setup(const std::string& arguments) const {
    return Shell("CALLS=$PWD/calls PATH=$PWD/bin:$PATH deploy/setup.sh " + arguments);
  }
};

TEST_F(SetupTest, AsksAptOnceForAllThatIsMissing) {
  const Run run = Setup("--checks");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(ReadFile("calls"), "update\ninstall\ndownload\n");
  EXPECT_EQ(run.LastLine(), "setup: everything is there");
}

TEST_F(SetupTest, AsksNothingWhereAllIsThere) {
  const Run first = Setup("--checks");
  const std::string::size_type begin = first.output.find("installing ") + 11;
  std::string installed = first.output.substr(begin, first.output.find('\n', begin) - begin);
  for (char& c : installed) c = c == ' ' ? '\n' : c;
  WriteFile("installed", installed + "\n");
  WriteFile("calls", "");
  const Run run = Setup("--quiet --checks");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.output, "");
  EXPECT_EQ(ReadFile("calls"), "");
}

TEST_F(SetupTest, RefusesWhatItDoesNotKnow) { EXPECT_EQ(Setup("--everything").exit_code, 2); }

}  // namespace
}  // namespace dhpmap
