// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/session_marks.h"

#include <gtest/gtest.h>

#include "mapping/map/map.h"

namespace dhpmap {
namespace {

TEST(SessionMarks, KeepTheLastSequenceOfEachSession) {
  SessionMarks marks;
  EXPECT_FALSE(marks.LastOf("a").has_value());
  marks.Set({"b", 7, 1});
  marks.Set({"a", -3, 2});
  EXPECT_EQ(marks.LastOf("a"), -3);
  EXPECT_EQ(marks.LastOf("b"), 7);
  EXPECT_FALSE(marks.LastOf("").has_value());
  EXPECT_FALSE(marks.LastOf("ab").has_value());
  marks.Set({"b", 8, 3});
  EXPECT_EQ(marks.LastOf("b"), 8);
  EXPECT_EQ(marks.marks(), (std::vector<SessionMark>{{"a", -3, 2}, {"b", 8, 3}}));
}

TEST(SessionMarks, OfTooManySessionsTheLongestUnusedGoes) {
  SessionMarks marks;
  const auto name = [](std::size_t i) { return "robot-" + std::to_string(i); };
  for (std::size_t i = 0; i < SessionMarks::kMost; ++i) marks.Set({name(i), 1, static_cast<std::int64_t>(i)});
  marks.Set({name(0), 2, 1000});  // used again
  marks.Set({"new", 5, 1001});
  EXPECT_EQ(marks.marks().size(), SessionMarks::kMost);
  EXPECT_EQ(marks.LastOf("new"), 5);
  EXPECT_EQ(marks.LastOf(name(0)), 2);
  EXPECT_FALSE(marks.LastOf(name(1)).has_value());
  EXPECT_EQ(marks.LastOf(name(2)), 1);
  EXPECT_TRUE(SessionMarks::Create(marks.marks()).ok());
}

TEST(SessionMarks, AreMadeOnlyOfWhatSetCouldHaveMade) {
  EXPECT_TRUE(SessionMarks::Create({}).ok());
  EXPECT_TRUE(SessionMarks::Create({{"a", 1, 1}, {"b", 1, 1}}).ok());
  for (const std::vector<SessionMark>& bad :
       {std::vector<SessionMark>{{"b", 1, 1}, {"a", 1, 1}}, {{"a", 1, 1}, {"a", 1, 1}}, {{"", 1, 1}}}) {
    EXPECT_EQ(SessionMarks::Create(bad).status().code(), StatusCode::kDataLoss);
  }
  std::vector<SessionMark> too_many;
  for (std::size_t i = 0; i <= SessionMarks::kMost; ++i) too_many.push_back({"m" + std::to_string(10000 + i), 1, 1});
  EXPECT_EQ(SessionMarks::Create(too_many).status().code(), StatusCode::kDataLoss);
}

TEST(SessionMarks, NamesAreShortAndPlain) {
  for (const char* good : {"a", "Robot_7.left-arm", "2026-11-22:05", "0b5f3b7e-7f0c-4a35-9b7a-5a2b1f0c8d11"}) {
    EXPECT_TRUE(ValidateSessionName(good).ok()) << good;
  }
  for (const std::string& bad : {std::string(), std::string("a b"), std::string("a\nb"), std::string("caf\xC3\xA9"),
                                 std::string("a/b"), std::string(65, 'x'), std::string("a\0b", 3)}) {
    const Status status = ValidateSessionName(bad);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << bad;
    EXPECT_EQ(status.reason(), Reason("BAD_SESSION"));
    ASSERT_EQ(status.violations().size(), 1u);
    EXPECT_EQ(status.violations()[0].field, "session");
  }
  EXPECT_TRUE(ValidateSessionName(std::string(64, 'x')).ok());
}

TEST(SessionMarks, ArePublishedWithTheFramesThatTheyAreOf) {
  MapInfo info;
  info.name = "room";
  Map map(info);
  const auto before = map.Publish(1);
  map.mutable_info().sessions.Set({"robot", 4, 2});
  EXPECT_FALSE(before->info().sessions.LastOf("robot").has_value());
  const auto after = map.Publish(2);
  EXPECT_EQ(after->revision(), before->revision() + 1);
  EXPECT_EQ(after->info().sessions.LastOf("robot"), 4);
  map.mutable_info().sessions.Set({"robot", 5, 3});
  map = Map(before);
  EXPECT_FALSE(map.info().sessions.LastOf("robot").has_value());
}

}  // namespace
}  // namespace dhpmap
