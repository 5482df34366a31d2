// SPDX-License-Identifier: BSD-3-Clause
#include "server/log/json_escape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/log/log.h"

namespace dhpmap {
namespace {

TEST(Log, AJsonLineStaysOneLineForAnyMessage) {
  EXPECT_EQ(EscapeForJson("a \"b\" \\ c\nd\te\x01"), "a \\\"b\\\" \\\\ c\\nd\\u0009e\\u0001");
  InitLog({.json_lines = true});
  ::testing::internal::CaptureStderr();
  LogError("she said \"{}\"\nand left");
  LogDebug("not shown");
  const std::string line = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(line.find(R"("level":"error","message":"she said \"{}\"\nand left"})"), std::string::npos) << line;
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
}

TEST(Log, LevelsHaveNames) {
  EXPECT_EQ(*LogLevelFromName("warning"), LogLevel::kWarning);
  EXPECT_FALSE(LogLevelFromName("loud").ok());
}

}  // namespace
}  // namespace dhpmap
