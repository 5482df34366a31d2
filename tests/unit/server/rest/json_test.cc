// SPDX-License-Identifier: BSD-3-Clause
#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "rest_test.pb.h"
#include "server/rest/json_reader.h"
#include "server/rest/json_writer.h"

namespace dhpmap::rest {
namespace {

using google::protobuf::util::MessageDifferencer;
using test::Everything;

Everything FullMessage() {
  Everything m;
  m.set_i32(-7);
  m.set_i64(std::numeric_limits<std::int64_t>::min());
  m.set_u32(std::numeric_limits<std::uint32_t>::max());
  m.set_u64(std::numeric_limits<std::uint64_t>::max());
  m.set_s32(std::numeric_limits<std::int32_t>::min());
  m.set_f64(1);
  m.set_real(0.1f);
  m.set_real_double(1e-300);
  m.set_flag(true);
  m.set_text("quote \" back \\ tab \t euro \xE2\x82\xAC nul \x01");
  m.set_raw(std::string("\x00\xFF\x10", 3));
  m.set_shade(test::DARK);
  m.mutable_child()->set_maybe(0);
  for (const std::int64_t i : {1, -2, 3}) m.add_many_i64(i);
  for (const float f : {0.5f, -1e20f, std::numeric_limits<float>::infinity()}) m.add_many_real(f);
  m.add_many_text("");
  m.add_many_text("b");
  m.add_many_shade(test::LIGHT);
  m.add_many_shade(static_cast<test::Shade>(99));
  m.add_many_child()->set_text("x");
  m.add_many_child();
  (*m.mutable_counts())["one"] = 1;
  (*m.mutable_children())[-5].set_flag(true);
  (*m.mutable_by_flag())[true] = "yes";
  m.mutable_choice_child()->set_u32(3);
  m.mutable_time()->set_seconds(1700000000);
  m.mutable_span()->set_nanos(5000000);
  m.mutable_mask()->add_paths("map_from_submap.translation_m");
  m.mutable_boxed()->set_value(0);
  m.mutable_boxed_text()->set_value("boxed");
  (*m.mutable_structure()->mutable_fields())["k"].set_number_value(2);
  m.mutable_value()->set_null_value(google::protobuf::NULL_VALUE);
  m.mutable_any()->PackFrom(m.child());
  m.add_times()->set_seconds(5);
  m.set_renamed("r");
  return m;
}

std::string Written(const Everything& message) {
  std::string text;
  AppendJson(message, &text);
  return text;
}

TEST(Json, WhatIsWrittenIsReadBackTheSame) {
  const Everything message = FullMessage();
  Everything back;
  const Status status = ReadJson(Written(message), &back);
  ASSERT_TRUE(status.ok()) << status.message() << "\n" << Written(message);
  EXPECT_TRUE(MessageDifferencer::Equals(message, back)) << back.DebugString();
}

TEST(Json, AgreesWithProtobufsOwnReaderAndWriter) {
  const Everything message = FullMessage();
  Everything theirs;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(Written(message), &theirs).ok());
  EXPECT_TRUE(MessageDifferencer::Equals(message, theirs)) << theirs.DebugString();

  for (const bool keep_names : {false, true}) {  // lowerCamel names as well
    google::protobuf::util::JsonPrintOptions options;
    options.preserve_proto_field_names = keep_names;
    std::string text;
    ASSERT_TRUE(google::protobuf::util::MessageToJsonString(message, &text, options).ok());
    Everything ours;
    const Status status = ReadJson(text, &ours);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_TRUE(MessageDifferencer::Equals(message, ours));
  }
}

TEST(Json, WritesZerosAndEmptyListsButNotWhatIsAbsent) {
  const std::string text = Written({});
  EXPECT_NE(text.find(R"("i32":0,"i64":"0")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("shade":"SHADE_UNSPECIFIED")"), std::string::npos);
  EXPECT_NE(text.find(R"("many_real":[])"), std::string::npos);
  EXPECT_NE(text.find(R"("counts":{})"), std::string::npos);
  for (const char* absent : {"maybe", "\"child\"", "choice", "time\"", "boxed"}) {
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
  }
}

struct Good {
  const char* text;
  const char* expected;  ///< text format
};

TEST(Json, TakesEveryAllowedSpelling) {
  const Good cases[] = {
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
  for (const Good& c : cases) {
    Everything got, expected;
    const Status status = ReadJson(c.text, &got);
    EXPECT_TRUE(status.ok()) << c.text << ": " << status.message();
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(c.expected, &expected)) << c.expected;
    EXPECT_TRUE(MessageDifferencer::Equals(expected, got)) << c.text << "\n" << got.DebugString();
  }
}

struct Bad {
  const char* text;
  const char* part;  ///< of the message
};

TEST(Json, SaysWhatIsWrongAndWhere) {
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
      {R"({"nothing":5})", "nothing: dhpmap.rest.test.Everything has no such field"},
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
      {R"({"shade":"PINK"})", "shade: expected a value of dhpmap.rest.test.Shade"},
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
    const Status status = ReadJson(c.text, &message);
    ASSERT_FALSE(status.ok()) << c.text;
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find(c.part), std::string::npos) << c.text << "\n  " << status.message();
  }
}

TEST(Json, NamesTheFieldAsAViolation) {
  Everything message;
  const Status status = ReadJson(R"({"child":{"i32":"x"}})", &message);
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "child.i32");
}

TEST(Json, RefusesDeepNestingInsteadOfOverflowingTheStack) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += R"({"child":)";
  Everything message;
  EXPECT_NE(ReadJson(text, &message).message().find("nested too deeply"), std::string::npos);
  EXPECT_FALSE(ReadJson("{\"structure\":{\"a\":" + std::string(100'000, '['), &message).ok());
}

TEST(Json, CollectsThePathsThatABodySets) {
  const std::pair<const char*, JsonPaths> cases[] = {
      {R"({})", {}},
      {R"({"text":"a","i32":0})", {"text", "i32"}},
      {R"({"child":{"realDouble":1,"child":{"flag":true}}})", {"child.real_double", "child.child.flag"}},
      {R"({"child":{},"text":null})", {"child", "text"}},
      {R"({"manyChild":[{"i32":1}],"counts":{"a":1},"times":[]})", {"many_child", "counts", "times"}},
      {R"({"time":"1970-01-01T00:00:05Z","mask":"a"})", {"time", "mask"}},
  };
  for (const auto& [text, expected] : cases) {
    Everything message;
    JsonPaths paths;
    ASSERT_TRUE(ReadJson(text, &message, &paths).ok()) << text;
    EXPECT_EQ(paths, expected) << text;
  }
}

/// Whatever the bytes: an error or a message, and what was read can be written and read again.
TEST(Json, MutatedTextNeverDoesHarm) {
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
    if (!ReadJson(text, &message).ok()) continue;
    ++num_read;
    Everything back;
    const Status status = ReadJson(Written(message), &back);
    ASSERT_TRUE(status.ok()) << status.message() << "\n" << text;
  }
  EXPECT_GT(num_read, 20) << "some mutations only change a value";
}

}  // namespace
}  // namespace dhpmap::rest
