// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/writer.h"

#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "server/json/reader.h"
#include "tests/unit/server/json/full_message.h"

namespace dhpmap::json {
namespace {

using google::protobuf::util::MessageDifferencer;
using test::Everything;

TEST(JsonWriter, WrittenMessagesAreReadBackUnchanged) {
  const Everything message = FullMessage();
  Everything back;
  const Status status = Read(Written(message), &back);
  ASSERT_TRUE(status.ok()) << status.message() << "\n" << Written(message);
  EXPECT_TRUE(MessageDifferencer::Equals(message, back)) << back.DebugString();
}

TEST(JsonWriter, ProtobufsReaderReadsTheOutput) {
  const Everything message = FullMessage();
  Everything theirs;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(Written(message), &theirs).ok());
  EXPECT_TRUE(MessageDifferencer::Equals(message, theirs)) << theirs.DebugString();
}

TEST(JsonWriter, WritesZerosAndEmptyListsButNoAbsentFields) {
  const std::string text = Written({});
  EXPECT_NE(text.find(R"("i32":0,"i64":"0")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("shade":"SHADE_UNSPECIFIED")"), std::string::npos);
  EXPECT_NE(text.find(R"("many_real":[])"), std::string::npos);
  EXPECT_NE(text.find(R"("counts":{})"), std::string::npos);
  for (const char* absent : {"maybe", "\"child\"", "choice", "time\"", "boxed"}) {
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
  }
}

TEST(JsonWriter, WritesOneField) {
  const auto written = [](const Everything& message, const char* name) {
    std::string text;
    AppendField(message, *Everything::descriptor()->FindFieldByName(name), &text);
    return text;
  };
  const Everything message = FullMessage();
  EXPECT_EQ(written(message, "i64"), R"("-9223372036854775808")");
  EXPECT_EQ(written(message, "raw"), R"("AP8Q")");
  EXPECT_EQ(written(message, "many_i64"), R"(["1","-2","3"])");
  EXPECT_EQ(written(message, "many_shade"), R"(["LIGHT",99])") << "a value without a name is its number";
  EXPECT_EQ(written({}, "child"), "null");
  EXPECT_EQ(written({}, "many_child"), "[]");
}

TEST(JsonWriter, NumbersAreReadBackBitExactly) {
  for (const double number : {0.1, 1e-300, -0.0, 5e-324, 1.7976931348623157e308, 1.0 / 3}) {
    Everything message, back;
    message.set_real_double(number);
    message.set_real(static_cast<float>(number));
    ASSERT_TRUE(Read(Written(message), &back).ok()) << Written(message);
    EXPECT_EQ(back.SerializeAsString(), message.SerializeAsString()) << Written(message);
  }
}

TEST(JsonWriter, IsOneLineWithTheNecessaryEscapes) {
  EXPECT_EQ(Written(FullMessage()).find_first_of("\n\r"), std::string::npos);
  std::string text;
  AppendString(std::string("\"\\\n\0\x1F/\x7F", 7), &text);
  EXPECT_EQ(text, "\"\\\"\\\\\\n\\u0000\\u001f/\\u007f\"");
}

}  // namespace
}  // namespace dhpmap::json
