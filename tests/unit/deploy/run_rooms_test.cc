// SPDX-License-Identifier: BSD-3-Clause
// deploy/ci/run_rooms.py, on binaries that are scripts: no case that a binary has may be lost from the count, and only
// a case that passes by itself may be forgiven.
#include "tests/unit/deploy/script_fixture.h"

namespace dhpmap {
namespace {

class RunRoomsTest : public ScriptTest {
 protected:
  /// A room of a binary that ends as plan.json says: for each case a list of what it does, run by run ("OK" once it is
  /// used up).
  void MakeRoom(const std::string& plan) const {
    WriteFile("plan.json", plan);
    WriteProgram("fake_test", R"py(#!/usr/bin/env python3
import json, os, sys
plan = json.load(open("plan.json"))
if "--gtest_list_tests" in sys.argv:
    suite = None
    for case in plan:
        if case.split(".")[0] != suite:
            suite = case.split(".")[0]
            print(suite + ".")
        print("  " + case.split(".")[1] + "  # GetParam() = 5")
    sys.exit(0)
flags = next(a for a in sys.argv if a.startswith("--gtest_flagfile=")).split("=")[1]
wanted = open(flags).read().strip().split("=")[1].split(":")
open("runs", "a").write(" ".join(wanted) + "\n")
failed = 0
for case in wanted:
    print("[ RUN      ] " + case, flush=True)
    does = plan[case].pop(0) if plan[case] else "OK"
    json.dump(plan, open("plan.json", "w"))
    if does == "crash": os.abort()
    if does == "leave": sys.exit(0)
    if does == "hang":
        import signal
        signal.pause()  # no signal comes
    if does == "report": print("==1==ERROR: AddressSanitizer: heap-use-after-free")
    if does == "forgotten": print("WARNING: ThreadSanitizer: data race\n    [failed to restore the stack]")
    ends = {"skip": "  SKIPPED ", "OK": "       OK "}.get(does, "  FAILED  ")
    failed += ends == "  FAILED  "
    print("words of " + case)
    print("[%s] %s (3 ms)" % (ends, case), flush=True)
sys.exit(1 if failed else int(os.environ.get("AT_END", "0")))
)py");
    WriteFile("rooms.json", R"([{"room": "unit/a", "target": "t", "command": ["./fake_test"], "is_gtest": true}])");
  }
  [[nodiscard]] Run RunRooms(const std::string& arguments = "") const {
    return Shell(Script("ci/run_rooms.py") + " rooms.json " + arguments);
  }
};

/// A case's limit counts from the start of its process, which a busy machine delays.
class RunRoomsClock : public RunRoomsTest {};

TEST_F(RunRoomsTest, CountsCasesNotBinaries) {
  MakeRoom(R"({"A.One": [], "A.Two/0": [], "B.One": []})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "3 passed, 0 failed");
  EXPECT_EQ(run.exit_code, 0);
}

TEST_F(RunRoomsTest, ACaseThatFailsTwiceIsAFailureAndWhatItWroteIsPrinted) {
  MakeRoom(R"({"A.One": ["fail", "fail"], "A.Two": []})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "1 passed, 1 failed");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(run.Says("words of A.One")) << run.output;
  EXPECT_FALSE(run.Says("words of A.Two")) << run.output;
}

TEST_F(RunRoomsTest, ACaseThatPassesByItselfIsToldAsUnstable) {
  MakeRoom(R"({"A.One": ["fail"], "A.Two": []})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "2 passed, 0 failed");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(run.Says("1 unstable: failed, and passed by itself:\n  unit/a/A.One\n")) << run.output;
}

TEST_F(RunRoomsTest, OfCasesThatLookAtNoClockTwoAreRunAgain) {
  MakeRoom(R"({"A.One": ["fail"], "A.Two": ["fail"], "A.Three": ["fail"]})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "2 passed, 1 failed");
  EXPECT_EQ(run.exit_code, 1);
}

TEST_F(RunRoomsTest, EachCaseThatLooksAtAClockIsRunAgain) {
  MakeRoom(R"({"AClock.One": ["fail"], "AClock.Two": ["fail"], "AClock.Three": ["fail"], "A.Four": ["fail"]})");
  EXPECT_EQ(RunRooms().LastLine(), "4 passed, 0 failed");
}

TEST_F(RunRoomsTest, CasesThatLookAtAClockRunAfterAllOthers) {
  MakeRoom(R"({"AClock.One": [], "B.One": [], "In/CClock.One/0": [], "DClock/0.One": []})");
  EXPECT_EQ(RunRooms("--jobs 2").LastLine(), "4 passed, 0 failed");
  EXPECT_EQ(ReadFile("runs"), "B.One\nAClock.One In/CClock.One/0 DClock/0.One\n");
}

TEST_F(RunRoomsTest, WhatASanitizerReportedIsNotRunAgain) {
  MakeRoom(R"({"A.One": ["report"], "AClock.One": ["report"]})");
  EXPECT_EQ(RunRooms().LastLine(), "0 passed, 2 failed");
  EXPECT_EQ(ReadFile("runs"), "A.One\nAClock.One\n");
}

TEST_F(RunRoomsTest, AReportWithAForgottenStackIsRunAgain) {
  MakeRoom(R"({"A.Once": ["forgotten"], "A.Twice": ["forgotten", "report"]})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "1 passed, 1 failed");
  EXPECT_TRUE(run.Says("1 unstable: failed, and passed by itself:\n  unit/a/A.Once\n")) << run.output;
}

TEST_F(RunRoomsTest, ACrashCostsTheCaseInWhichItCame) {
  MakeRoom(R"({"A.One": [], "A.Two": ["crash", "crash"], "A.Three": []})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "2 passed, 1 failed");
  EXPECT_TRUE(run.Says("unit/a/A.Two")) << run.output;
}

TEST_F(RunRoomsTest, AProcessThatEndsWellInACaseHasFailedIt) {
  MakeRoom(R"({"A.One": ["leave", "leave"], "A.Two": []})");
  EXPECT_EQ(RunRooms().LastLine(), "1 passed, 1 failed");
}

TEST_F(RunRoomsTest, ABinaryThatFailsAtItsEndIsAFailure) {
  MakeRoom(R"({"A.One": []})");
  const Run run = Shell("AT_END=3 " + Script("ci/run_rooms.py") + " rooms.json");
  EXPECT_EQ(run.LastLine(), "1 passed, 1 failed");
  EXPECT_EQ(run.exit_code, 1);
}

TEST_F(RunRoomsClock, ACaseThatHangsIsKilledAndFails) {
  MakeRoom(R"({"A.One": ["hang", "hang"], "A.Two": []})");
  const Run run = RunRooms("--case-limit 2");
  EXPECT_EQ(run.LastLine(), "1 passed, 1 failed");
  EXPECT_TRUE(run.Says("it took longer than 2 s")) << run.output;
}

TEST_F(RunRoomsTest, WhatIsLeftAtTheEndOfTheTimeIsToldAndNoFailure) {
  MakeRoom(R"({"A.One": [], "A.Two": []})");
  const Run run = RunRooms("--until 1");
  EXPECT_EQ(run.LastLine(), "0 passed, 0 failed");
  EXPECT_TRUE(run.Says("cut off: 2 cases of unit/a")) << run.output;
  EXPECT_EQ(run.exit_code, 0);
}

TEST_F(RunRoomsTest, ACaseThatSkipsItselfHasNeitherPassedNorFailed) {
  MakeRoom(R"({"A.One": ["skip"], "A.Two": []})");
  const Run run = RunRooms();
  EXPECT_EQ(run.LastLine(), "1 passed, 0 failed");
  EXPECT_TRUE(run.Says("1 skipped:\n  unit/a/A.One")) << run.output;
}

TEST_F(RunRoomsTest, ABinaryThatIsMissingOrListsNothingIsAFailure) {
  MakeRoom("{}");
  EXPECT_EQ(RunRooms().LastLine(), "0 passed, 1 failed");
  WriteFile("rooms.json", R"([{"room": "unit/a", "target": "t", "command": ["./missing"], "is_gtest": true}])");
  EXPECT_EQ(RunRooms().LastLine(), "0 passed, 1 failed");
}

TEST_F(RunRoomsTest, AProgramWithoutGoogleTestIsOneCase) {
  WriteFile("rooms.json", R"([{"room": "unit/t", "target": "t", "command": ["true"], "is_gtest": false},
                              {"room": "unit/f", "target": "t", "command": ["false"], "is_gtest": false}])");
  EXPECT_EQ(RunRooms().LastLine(), "1 passed, 1 failed");
  EXPECT_EQ(RunRooms("--rooms '^unit/t$'").LastLine(), "1 passed, 0 failed");
  EXPECT_EQ(RunRooms("--rooms nothing").LastLine(), "0 passed, 1 failed");
}

}  // namespace
}  // namespace dhpmap
