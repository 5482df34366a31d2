// SPDX-License-Identifier: BSD-3-Clause
// deploy/count_cases.sh, on binaries that are scripts: no case that a test binary has may be lost from the count.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

class CountCasesTest : public ::testing::Test {
 protected:
  CountCasesTest() { fs::create_directory(folder_.path() / "reports"); }

  /// A binary unit_a_test of room unit/a that lists three cases.
  void MakeBinary(const std::string& script = "printf 'Suite.\\n  One\\n  Two/0  # GetParam() = 5\\n  Three\\n'") {
    const fs::path binary = folder_.path() / "unit_a_test";
    std::ofstream(binary) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(binary, fs::perms::owner_all);
  }
  void MakeReport(int tests, int failures, int disabled = 0, const std::string& shard = "", int skipped = 0) {
    std::ofstream(folder_.path() / "reports" / ("unit_a_test" + shard + ".xml"))
        << R"(<?xml version="1.0" encoding="UTF-8"?>)"
        << "\n<testsuites tests=\"" << tests << "\" failures=\"" << failures << "\" disabled=\"" << disabled
        << "\" errors=\"0\" time=\"0.5\" name=\"AllTests\">\n"
        << R"(  <testsuite name="Suite" tests="9" failures="9" disabled="9" errors="9">)"
        << "\n";
    std::ofstream report(folder_.path() / "reports" / ("unit_a_test" + shard + ".xml"), std::ios::app);
    for (int i = 0; i < skipped; ++i) {
      report << R"(    <testcase name="One" status="run" result="skipped" time="0" classname="Suite">)"
             << "\n";
    }
  }
  /// What ctest says of room unit/a.
  void MakeLog(const std::string& ended) {
    std::ofstream(Log()) << "      Start  1: unit/a\n"
                         << "1/1 Test  #1: unit/a ............................" << ended << "    0.52 sec\n";
  }
  [[nodiscard]] fs::path Log() const { return folder_.path() / "log"; }

  /// The last line.
  [[nodiscard]] std::string Count(const std::string& rooms = "unit/a") const {
    const std::string command = (testing::SourceDir() / "deploy/count_cases.sh").string() + " " +
                                folder_.path().string() + " " + Log().string() + " " + rooms + " | tail -n 1";
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 200> line{};
    const char* read = fgets(line.data(), line.size(), pipe);
    pclose(pipe);
    return read == nullptr ? "" : read;
  }

  testing::TempDir folder_;
};

TEST_F(CountCasesTest, CountsCasesNotBinaries) {
  MakeBinary();
  MakeReport(3, 0);
  MakeLog("   Passed");
  EXPECT_EQ(Count(), "3 passed, 0 failed\n");
}

TEST_F(CountCasesTest, CountsFailedCases) {
  MakeBinary();
  MakeReport(3, 2);
  MakeLog("***Failed");
  EXPECT_EQ(Count(), "1 passed, 2 failed\n");
}

TEST_F(CountCasesTest, ACaseThatSkipsItselfHasNeitherPassedNorFailed) {
  MakeBinary();
  MakeReport(3, 0, 0, "", 2);
  MakeLog("   Passed");
  EXPECT_EQ(Count(), "1 passed, 0 failed\n");
  MakeReport(3, 1, 0, "", 2);
  MakeLog("***Failed");
  EXPECT_EQ(Count(), "0 passed, 1 failed\n");
}

TEST_F(CountCasesTest, AllCasesOfABinaryThatCrashedFail) {
  MakeBinary();
  MakeLog("***Exception: SegFault");
  EXPECT_EQ(Count(), "0 passed, 3 failed\n");
}

TEST_F(CountCasesTest, ACaseThatDidNotRunFails) {
  MakeBinary();
  MakeReport(2, 0);
  MakeLog("   Passed");
  EXPECT_EQ(Count(), "2 passed, 1 failed\n");
  MakeReport(3, 0, 1);
  EXPECT_EQ(Count(), "2 passed, 1 failed\n") << "disabled";
}

TEST_F(CountCasesTest, ABinaryThatFailsAfterItsLastCaseIsAFailure) {
  MakeBinary();
  MakeReport(3, 0);
  MakeLog("***Failed");
  EXPECT_EQ(Count(), "2 passed, 1 failed\n");
}

TEST_F(CountCasesTest, ABinaryThatListsNothingIsAFailure) {
  MakeReport(3, 0);
  MakeLog("   Passed");
  for (const char* script : {"exit 0", "exit 1", "echo Suite."}) {
    MakeBinary(script);
    EXPECT_EQ(Count(), "0 passed, 1 failed\n") << script;
  }
}

TEST_F(CountCasesTest, AProgramThatIsNoTestBinaryIsOneCase) {
  MakeLog("   Passed");
  EXPECT_EQ(Count(), "1 passed, 0 failed\n");
  MakeLog("***Not Run");
  EXPECT_EQ(Count(), "0 passed, 1 failed\n");
}

TEST_F(CountCasesTest, ShardsOfABinaryAreCountedTogether) {
  MakeBinary();
  MakeReport(2, 0, 0, ".1of2");
  MakeReport(1, 0, 0, ".2of2");
  const auto log = [this](const std::string& second) {
    std::ofstream(Log()) << "1/2 Test  #1: unit/a.1of2 ..............   Passed    0.52 sec\n"
                         << "2/2 Test  #2: unit/a.2of2 ..............   " << second << "    0.52 sec\n";
  };
  log("Passed");
  EXPECT_EQ(Count("unit/a.1of2 unit/a.2of2"), "3 passed, 0 failed\n");
  log("***Failed");
  EXPECT_EQ(Count("unit/a.1of2 unit/a.2of2"), "2 passed, 1 failed\n");
  std::filesystem::remove(folder_.path() / "reports" / "unit_a_test.2of2.xml");
  EXPECT_EQ(Count("unit/a.1of2 unit/a.2of2"), "2 passed, 1 failed\n") << "a shard that said nothing";
}

TEST_F(CountCasesTest, AddsUpRooms) {
  MakeBinary();
  MakeReport(3, 0);
  MakeLog("   Passed");
  EXPECT_EQ(Count("unit/a unit/b"), "3 passed, 1 failed\n") << "ctest knows nothing of unit/b";
  EXPECT_EQ(Count(""), "0 passed, 1 failed\n");
}

}  // namespace
}  // namespace dhpmap
