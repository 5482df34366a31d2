// SPDX-License-Identifier: BSD-3-Clause
#include "server/log/log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace dhpmap {
namespace {

/// The lines that `work` writes to standard error.
std::vector<std::string> Logged(const LogOptions& options, const std::function<void()>& work) {
  InitLog(options);
  ::testing::internal::CaptureStderr();
  work();
  std::istringstream text(::testing::internal::GetCapturedStderr());
  InitLog({});
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

void LogOneOfEach() {
  LogDebug("d");
  LogInfo("i");
  LogWarning("w");
  LogError("e");
}

TEST(Log, KnowsItsLevelsByName) {
  const std::pair<const char*, LogLevel> levels[] = {{"debug", LogLevel::kDebug},
                                                     {"info", LogLevel::kInfo},
                                                     {"warning", LogLevel::kWarning},
                                                     {"error", LogLevel::kError},
                                                     {"off", LogLevel::kOff}};
  for (const auto& [name, level] : levels) EXPECT_EQ(*LogLevelFromName(name), level);
  for (const char* name : {"", "Info", "warn", "trace", "info "}) {
    const Status status = LogLevelFromName(name).status();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << name;
    EXPECT_NE(status.message().find("debug, info, warning, error and off"), std::string::npos) << status.message();
  }
}

TEST(Log, LogsMessagesOfItsLevelOrAbove) {
  const std::pair<LogLevel, std::size_t> cases[] = {
      {LogLevel::kDebug, 4}, {LogLevel::kInfo, 3}, {LogLevel::kWarning, 2}, {LogLevel::kError, 1}, {LogLevel::kOff, 0}};
  for (const auto& [level, num_lines] : cases) {
    EXPECT_EQ(Logged({.level = level}, LogOneOfEach).size(), num_lines) << static_cast<int>(level);
  }
}

TEST(Log, ALineContainsUtcTimeLevelAndTheUnchangedMessage) {
  const auto lines = Logged({}, [] { LogWarning("100 % of {} and {0:x} \\n"); });
  ASSERT_EQ(lines.size(), 1u);
  const std::regex line(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z warning 100 % of \{\} and \{0:x\} \\n)");
  EXPECT_TRUE(std::regex_match(lines[0], line)) << lines[0];
}

TEST(Log, AnyMessageIsOneLineOfJson) {
  const auto lines = Logged({.json_lines = true}, [] { LogError("two\nlines, \"quoted\" \\ \x01"); });
  ASSERT_EQ(lines.size(), 1u);
  const std::regex line(R"re(\{"time":"[^"]*Z","level":"error","message":"(.*)"\})re");
  std::smatch match;
  ASSERT_TRUE(std::regex_match(lines[0], match, line)) << lines[0];
  EXPECT_EQ(match[1], R"(two\nlines, \"quoted\" \\ \u0001)");
}

TEST(Log, LinesForTheJournalBeginWithTheirPriorityAndHaveNoTime) {
  EXPECT_EQ(Logged({.level = LogLevel::kDebug, .is_journal = true}, LogOneOfEach),
            (std::vector<std::string>{"<7>d", "<6>i", "<4>w", "<3>e"}));
  const auto two_lines = Logged({.is_journal = true}, [] { LogError("of a client:\n<0>the machine is down"); });
  EXPECT_EQ(two_lines, std::vector<std::string>{"<3>of a client: <0>the machine is down"}) << "one entry";
  const auto json = Logged({.json_lines = true, .is_journal = true}, [] { LogInfo("i"); });
  ASSERT_EQ(json.size(), 1u);
  EXPECT_TRUE(json[0].starts_with("<6>{\"time\":")) << json[0];
}

TEST(Log, TheJournalIsDetectedByStandardError) {
  struct stat stream {};
  ASSERT_EQ(::fstat(STDERR_FILENO, &stream), 0);
  const std::string device = std::to_string(stream.st_dev), inode = std::to_string(stream.st_ino);
  EXPECT_TRUE(IsJournal(device + ":" + inode));
  for (const std::string& other : {std::string(), device, device + ":" + inode + "0", ":" + inode}) {
    EXPECT_FALSE(IsJournal(other)) << other;
  }
}

TEST(Log, ALevelAppliesFromTheNextLine) {
  const auto lines = Logged({}, [] {
    LogDebug("not shown");
    SetLogLevel(LogLevel::kDebug);
    LogDebug("shown");
    SetLogLevel(LogLevel::kError);
    LogWarning("not shown");
  });
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].ends_with(" debug shown")) << lines[0];
}

TEST(Log, LinesOfSeveralThreadsDoNotMix) {
  const std::string tail(200, 'x');
  const auto lines = Logged({}, [&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&tail] {
        for (int k = 0; k < 100; ++k) LogInfo(tail);
      });
    }
    for (std::thread& thread : threads) thread.join();
  });
  EXPECT_EQ(lines.size(), 400u);
  EXPECT_TRUE(std::all_of(lines.begin(), lines.end(),
                          [&](const std::string& line) { return line.ends_with(" info " + tail); }));
}

}  // namespace
}  // namespace dhpmap
