// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/cursor.h"

#include <gtest/gtest.h>

#include <string>

namespace dhpmap::json {
namespace {

/// The error of a text that should be one value; "" if it is valid.
std::string ProblemOf(const std::string& text) {
  Cursor cursor(text);
  if (cursor.SkipValue()) cursor.ExpectEnd();
  return cursor.status().message();
}

std::string StringOf(const std::string& text) {
  Cursor cursor(text);
  std::string_view value;
  std::string scratch;
  return cursor.ReadString(&value, &scratch) ? std::string(value) : "failed: " + cursor.status().message();
}

TEST(Cursor, ReadsEveryKindOfValue) {
  for (const char* text :
       {"{}", "[]", " [1, -2.5e+3, \"a\", true, false, null, {\"b\": [0]}] ", "\"\"", "0", "-0.1E-2"}) {
    EXPECT_EQ(ProblemOf(text), "") << text;
  }
}

TEST(Cursor, RefusesTextOutsideRfc8259) {
  for (const char* text :
       {"",    "{",   "[1,]", "{\"a\":1,}", "{a:1}",     "01",       "1.",  ".5",    "+1",    "1e",
        "tru", "nul", "NaN",  "\"\\x\"",    "\"\\u12\"", "\"a\nb\"", "'a'", "[1 2]", "{} {}", "// c\n1"}) {
    EXPECT_NE(ProblemOf(text), "") << text;
  }
}

TEST(Cursor, DecodesEscapes) {
  EXPECT_EQ(StringOf(R"("a\"\\\/\b\f\n\r\tz")"), "a\"\\/\b\f\n\r\tz");
  EXPECT_EQ(StringOf(R"("\u0041\u00e4\u20AC\ud83d\ude00")"), "A\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
  for (const char* half : {R"("\ud83d")", R"("\ude00")", R"("\ud83dx")", R"("\ud83d\u0041")"}) {
    EXPECT_NE(StringOf(half).find("surrogate"), std::string::npos) << half;
  }
}

TEST(Cursor, AStringWithoutEscapesIsAViewOfTheText) {
  const std::string text = "\"plain\"";
  Cursor cursor(text);
  std::string_view value;
  std::string scratch;
  ASSERT_TRUE(cursor.ReadString(&value, &scratch));
  EXPECT_EQ(value.data(), text.data() + 1);
}

TEST(Cursor, ReportsWhereItFailed) {
  EXPECT_EQ(ProblemOf("{\n \"a\": x}"), "expected a number but found 'x', at line 2, column 7 (byte 8)");
}

TEST(Cursor, KeepsTheFirstError) {
  Cursor cursor("x");
  EXPECT_FALSE(cursor.FailAt(0, "first"));
  EXPECT_FALSE(cursor.Fail("second"));
  EXPECT_EQ(cursor.status().message().substr(0, 5), "first");
}

TEST(Cursor, DeepNestingIsAnErrorNotACrash) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(ProblemOf(nested(kMaxDepth)), "");
  EXPECT_NE(ProblemOf(nested(kMaxDepth + 1)).find("nested too deeply"), std::string::npos);
  EXPECT_NE(ProblemOf(std::string(1u << 20, '[')).find("nested too deeply"), std::string::npos);
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  EXPECT_NE(ProblemOf(objects).find("nested too deeply"), std::string::npos);
}

TEST(Cursor, ANulByteIsNotTheEndOfTheText) {
  EXPECT_NE(ProblemOf(std::string("{}\0", 3)), "");
  EXPECT_NE(ProblemOf(std::string("\0", 1)), "");
  EXPECT_NE(ProblemOf(std::string("\"a\0b\"", 5)), "") << "a control character must be escaped";
}

}  // namespace
}  // namespace dhpmap::json
