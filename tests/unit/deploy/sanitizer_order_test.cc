// SPDX-License-Identifier: BSD-3-Clause
// deploy/ci/sanitizer_order.py: which rooms sanitizers take first.
#include "tests/unit/deploy/script_fixture.h"

namespace dhpmap {
namespace {

class SanitizerOrderTest : public ScriptTest {
 protected:
  /// A line of names; `expression` sees the module's names.
  [[nodiscard]] std::string Python(const std::string& expression) const {
    const std::string code = "from sanitizer_order import *; print(*" + expression + ")";
    return Shell("PYTHONPATH=" + Script("ci") + " python3 -B -c '" + code + "'").LastLine();
  }
};

constexpr char kRooms[] =
    R"(["unit/mapping/map", "unit/mapping/query", "unit/server/wire", "unit/server/wire/types", "unit/storage", "integration"])";

TEST_F(SanitizerOrderTest, TouchedRoomsComeFirstInTheirOrder) {
  EXPECT_EQ(Python(std::string("in_order(") + kRooms + R"(, ["storage/codec/a.cc", "mapping/query/b.h"], 0))"),
            "unit/storage unit/mapping/query unit/mapping/map unit/server/wire unit/server/wire/types integration");
}

TEST_F(SanitizerOrderTest, TheOthersBeginWithAnotherEachTurn) {
  EXPECT_EQ(Python(std::string("in_order(") + kRooms + R"(, ["storage/a.cc"], 3))"),
            "unit/storage unit/server/wire/types integration unit/mapping/map unit/mapping/query unit/server/wire");
}

TEST_F(SanitizerOrderTest, AFileBelongsToTheInnermostRoomAroundIt) {
  EXPECT_EQ(Python(std::string(R"(rooms_of("server/wire/types/a.cc", )") + kRooms + ")"),
            "unit/server/wire/types integration");
  EXPECT_EQ(Python(std::string(R"(rooms_of("tests/unit/mapping/map/a_test.cc", )") + kRooms + ")"), "unit/mapping/map");
  EXPECT_EQ(Python(std::string(R"(rooms_of("README.md", )") + kRooms + ")"), "");
}

TEST_F(SanitizerOrderTest, CommitsOfTheLastDayBeforeTheNewestCount) {
  const Run made = Shell(R"(git init -q . && git config user.name a && git config user.email a@b
    commit() { mkdir -p "$1" && date +%N >"$1/a.cc" && git add . && GIT_COMMITTER_DATE="$2" git commit -q -m "$1"; }
    commit storage 2020-01-01T00:00:00Z && commit server 2020-01-02T13:00:00Z && commit mapping 2020-01-03T12:00:00Z)");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_EQ(Python("touched_files()"), "mapping/a.cc server/a.cc");
}

}  // namespace
}  // namespace dhpmap
