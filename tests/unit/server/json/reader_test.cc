// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/reader.h"

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <random>

#include "server/json/writer.h"
#include "tests/unit/server/json/full_message.h"

namespace dhpmap::json {
namespace {

using google::protobuf::util::MessageDifferencer;
using test::Everything;

TEST(JsonReader, ReadsTheOutputOfProtobufsWriter) {
  const Everything message = FullMessage();
  for (const bool keep_names : {false, true}) {  // lowerCamel names as well
    google::protobuf::util::JsonPrintOptions options;
    options.preserve_proto_field_names = keep_names;
    std::string text;
    ASSERT_TRUE(google::protobuf::util::MessageToJsonString(message, &text, options).ok());
    Everything ours;
    const Status status = Read(text, &ours);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_TRUE(MessageDifferencer::Equals(message, ours));
  }
}

struct GoodMessage {
  const char* text;
  const char* expected;  ///< text format
};

TEST(JsonReader, AcceptsEveryAllowedSpelling) {
  const GoodMessage cases[] = {
      {R"({})", ""},
      {" \n\t{ } \r\n", ""},
      {R"({"i32":"12","i64":13,"u64":"14"})", "i32: 12 i64: 13 u64: 14"},
      {R"({"i32":1e3,"i64":-2.0,"u32":4.5e1})", "i32: 1000 i64: -2 u32: 45"},
      {R"({"real":"1.5","realDouble":"-Infinity"})", "real: 1.5 real_double: -inf"},
      {R"({"real":1e-60,"real_double":1e-400})", ""},
      {R"({"shade":"LIGHT","manyShade":[2,"DARK"]})", "shade: LIGHT many_shade: [DARK, DARK]"},
      {R"({"raw":"_-8","flag":false})", R"(raw: "\377\357")"},
      {R"({"text":"\u00e4\ud83d\ude00\/\b"})", "text: \"\xC3\xA4\xF0\x9F\x98\x80/\\010\""},
      {R"({"child":null,"many_i64":null,"i32":null})", ""},
      {R"({"other-name":"x"})", R"(renamed: "x")"},
      {R"({"renamed":"x"})", R"(renamed: "x")"},
      {R"({"counts":{"a":1,"b":"2"}})", R"(counts {key: "a" value: 1} counts {key: "b" value: 2})"},
      {R"({"mask":"displayName,a.bC,snake_case"})", R"(mask {paths: ["display_name", "a.b_c", "snake_case"]})"},
      {R"({"boxed":5,"time":"1970-01-01T00:00:05Z","span":"1.5s"})",
       "boxed {value: 5} time {seconds: 5} span {seconds: 1 nanos: 500000000}"},
  };
  for (const GoodMessage& c : cases) {
    Everything got, expected;
    const Status status = Read(c.text, &got);
    EXPECT_TRUE(status.ok()) << c.text << ": " << status.message();
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(c.expected, &expected)) << c.expected;
    EXPECT_TRUE(MessageDifferencer::Equals(expected, got)) << c.text << "\n" << got.DebugString();
  }
}

struct Bad {
  const char* text;
  const char* part;  ///< of the message
};

TEST(JsonReader, ReportsTheErrorAndItsPosition) {
  const Bad cases[] = {
      {"", "found the end of the text, at line 1, column 1 (byte 0)"},
      {"{", "found the end of the text"},
      {"[]", "expected '{'"},
      {"{}{}", "unexpected '{' after the end of the value, at line 1, column 3 (byte 2)"},
      {"{\n \"i32\" 5}", "expected ':' but found '5', at line 2, column 8 (byte 9)"},
      {R"({"i32":5,})", "expected a string but found '}'"},
      {R"({'i32':5})", "expected a string"},
      {R"({i32:5})", "expected a string"},
      {R"({"i32":05})", "must not start with 0"},
      {R"({"i32":+5})", "expected a number"},
      {R"({"real":1.})", "digits must follow"},
      {R"({"real":.5})", "expected a number"},
      {R"({"real":NaN})", "expected a number"},
      {R"({"flag":tru})", "expected true"},
      {"{\"text\":\"a\nb\"}", "control character"},
      {R"({"text":"\x"})", "unknown escape"},
      {R"({"text":"\ud800"})", "half of a surrogate pair"},
      {R"({"text":"\udc00"})", "half of a surrogate pair"},
      {R"({"text":"abc)", "does not end, at line 1, column 9"},
      {"{\"text\":\"\xFF\"}", "not UTF-8, at line 1, column 10"},
      {R"({"nothing":5})", "nothing: dhpmap.json.test.Everything has no such field"},
      {R"({"child":{"nothing":5}})", "child.nothing:"},
      {R"({"i32":5,"i32":6})", "i32: given twice"},
      {R"({"manyReal":[],"many_real":[]})", "many_real: given twice"},
      {R"({"choice_text":"a","choice_child":{}})", "another member of 'choice'"},
      {R"({"i32":2147483648})", "i32: expected an integer of 32 bits, at line 1, column 8"},
      {R"({"i32":1.5})", "i32: expected an integer"},
      {R"({"u32":-1})", "u32: expected a non-negative"},
      {R"({"i32":"0x10"})", "i32: expected an integer"},
      {R"({"i32":true})", "i32: expected a number"},
      {R"({"i32":""})", "i32: expected an integer"},
      {R"({"real":1e39})", "real: expected a number"},
      {R"({"real":"inf"})", "real: expected a number"},
      {R"({"real":"nan"})", "real: expected a number"},
      {R"({"flag":"true"})", "flag: expected true or false"},
      {R"({"flag":1})", "flag: expected true or false"},
      {R"({"text":5})", "text: expected a string"},
      {R"({"raw":"@@"})", "raw: expected base64"},
      {R"({"raw":[1]})", "raw: expected base64"},
      {R"({"shade":"PINK"})", "shade: expected a value of dhpmap.json.test.Shade"},
      {R"({"child":5})", "child: expected an object"},
      {R"({"child":[]})", "child: expected an object"},
      {R"({"many_i64":5})", "many_i64: expected a list"},
      {R"({"many_child":[{},{"i32":"x"}]})", "many_child[1].i32: expected an integer"},
      {R"({"many_real":[1,"x"]})", "many_real[1]: expected a number"},
      {R"({"many_i64":[null]})", "expected a number"},
      {R"({"counts":[]})", "counts: expected an object"},
      {R"({"children":{"x":{}}})", "children: key: expected an integer"},
      {R"({"time":"yesterday"})", "time: expected a google.protobuf.Timestamp"},
      {R"({"mask":5})", "mask: expected field names"},
      {R"({"any":{"@type":"type.googleapis.com/no.such.Type"}})", "any: expected a google.protobuf.Any"},
  };
  for (const Bad& c : cases) {
    Everything message;
    const Status status = Read(c.text, &message);
    ASSERT_FALSE(status.ok()) << c.text;
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find(c.part), std::string::npos) << c.text << "\n  " << status.message();
  }
}

TEST(JsonReader, NamesTheFieldAsAViolation) {
  Everything message;
  const Status status = Read(R"({"child":{"i32":"x"}})", &message);
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "child.i32");
}

TEST(JsonReader, RefusesDeepNestingInsteadOfOverflowingTheStack) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += R"({"child":)";
  Everything message;
  EXPECT_NE(Read(text, &message).message().find("nested too deeply"), std::string::npos);
  EXPECT_FALSE(Read("{\"structure\":{\"a\":" + std::string(100'000, '['), &message).ok());
}

TEST(JsonReader, CollectsThePathsOfSetFields) {
  const std::pair<const char*, Paths> cases[] = {
      {R"({})", {}},
      {R"({"text":"a","i32":0})", {"text", "i32"}},
      {R"({"child":{"realDouble":1,"child":{"flag":true}}})", {"child.real_double", "child.child.flag"}},
      {R"({"child":{},"text":null})", {"child", "text"}},
      {R"({"manyChild":[{"i32":1}],"counts":{"a":1},"times":[]})", {"many_child", "counts", "times"}},
      {R"({"time":"1970-01-01T00:00:05Z","mask":"a"})", {"time", "mask"}},
  };
  for (const auto& [text, expected] : cases) {
    Everything message;
    Paths paths;
    ASSERT_TRUE(Read(text, &message, &paths).ok()) << text;
    EXPECT_EQ(paths, expected) << text;
  }
}

TEST(JsonReader, MergesIntoAnExistingMessage) {
  Everything message;
  message.set_i32(1);
  message.mutable_child()->set_i32(2);
  message.add_many_i64(3);
  ASSERT_TRUE(Read(R"({"child":{"text":"x"},"many_i64":[4]})", &message).ok());
  EXPECT_EQ(message.i32(), 1);
  EXPECT_EQ(message.child().i32(), 2);
  EXPECT_EQ(message.child().text(), "x");
  EXPECT_EQ(message.many_i64_size(), 2);
}

TEST(JsonReader, ReadsTheValueOfOneField) {
  const auto field = [](const char* name) -> const auto& { return *Everything::descriptor()->FindFieldByName(name); };
  Everything message;
  Paths paths;
  ASSERT_TRUE(ReadField(R"( "only" )", field("text"), &message).ok());
  EXPECT_EQ(message.text(), "only");
  ASSERT_TRUE(ReadField(R"([{"i32":1},{}])", field("many_child"), &message).ok());
  EXPECT_EQ(message.many_child_size(), 2);
  ASSERT_TRUE(ReadField(R"({"i32":1,"child":{"flag":true}})", field("child"), &message, &paths).ok());
  EXPECT_EQ(paths, (Paths{"i32", "child.flag"})) << "relative to the field";
  EXPECT_FALSE(ReadField(R"("a" "b")", field("text"), &message).ok());
  EXPECT_FALSE(ReadField("5", field("text"), &message).ok());
}

/// Any bytes give an error or a message that can be written and read again.
TEST(JsonReader, MutatedTextIsHarmless) {
  const std::string seed = Written(FullMessage());
  std::mt19937 random(20240501);
  const std::string alphabet = "{}[]\",:\\0123456789eE+-.tfn ual\xFF\x80\x01";
  int num_read = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = seed;
    const int num_changes = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < num_changes; ++i) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0: text[at] = alphabet[random() % alphabet.size()]; break;
        case 1: text.erase(at, 1 + random() % 8); break;
        case 2: text.insert(at, 1, alphabet[random() % alphabet.size()]); break;
        default: text.resize(at + 1);
      }
      if (text.empty()) text = "{";
    }
    Everything message;
    if (!Read(text, &message).ok()) continue;
    ++num_read;
    Everything back;
    const Status status = Read(Written(message), &back);
    ASSERT_TRUE(status.ok()) << status.message() << "\n" << text;
  }
  EXPECT_GT(num_read, 20) << "some mutations only change a value";
}

}  // namespace
}  // namespace dhpmap::json
