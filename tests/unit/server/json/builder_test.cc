// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/builder.h"

#include <gtest/gtest.h>

namespace dhpmap::json {
namespace {

TEST(Builder, InsertsCommas) {
  Builder out;
  out.BeginObject().Member("a", "1").Key("b").BeginArray().String("x").Raw("2").BeginObject().EndObject().EndArray();
  out.RawMember("c", "null").EndObject();
  EXPECT_EQ(out.Take(), R"({"a":"1","b":["x",2,{}],"c":null})");
}

TEST(Builder, EscapesKeysAndValues) {
  Builder out;
  out.BeginObject().Member("a\"b", "c\\\n").EndObject();
  EXPECT_EQ(out.Take(), R"({"a\"b":"c\\\n"})");
}

TEST(Builder, EmptyThingsAreEmpty) {
  Builder out;
  out.BeginArray().BeginArray().EndArray().BeginObject().EndObject().EndArray();
  EXPECT_EQ(out.Take(), "[[],{}]");
}

}  // namespace
}  // namespace dhpmap::json
