// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/field_text.h"

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "json_test.pb.h"

namespace dhpmap::json {
namespace {

using test::Everything;

Status Set(const std::string& name, const std::string& text, Everything* message) {
  FieldPath path;
  DHPMAP_RETURN_IF_ERROR(ResolveFieldPath(*Everything::descriptor(), name, &path));
  return SetFieldFromText(path, text, message);
}

TEST(FieldText, FindsAFieldByEitherOfItsNames) {
  const auto& type = *Everything::descriptor();
  EXPECT_EQ(FindField(type, "many_i64"), FindField(type, "manyI64"));
  EXPECT_EQ(FindField(type, "many_i64")->name(), "many_i64");
  EXPECT_EQ(FindField(type, "other-name")->name(), "renamed");
  for (const char* name : {"", "Many_i64", "manyi64", "nothing", "child.i32"})
    EXPECT_EQ(FindField(type, name), nullptr);
}

TEST(FieldText, APathHasTwoEqualSpellings) {
  FieldPath proto, camel;
  ASSERT_TRUE(ResolveFieldPath(*Everything::descriptor(), "child.choice_child.real_double", &proto).ok());
  ASSERT_TRUE(ResolveFieldPath(*Everything::descriptor(), "child.choiceChild.realDouble", &camel).ok());
  EXPECT_EQ(proto, camel);
  EXPECT_EQ(ToString(camel), "child.choice_child.real_double");
}

TEST(FieldText, NamesTheFirstPartOfAPathThatDoesNotExist) {
  FieldPath path;
  const std::pair<const char*, const char*> cases[] = {
      {"child.nothing.i32", "nothing"}, {"", ""},          {"child..i32", ""}, {"i32.x", "x"},
      {"many_child.i32", "i32"},        {"counts.a", "a"}, {".i32", ""},
  };
  for (const auto& [name, part] : cases) {
    const Status status = ResolveFieldPath(*Everything::descriptor(), name, &path);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << name;
    EXPECT_NE(status.message().find(part), std::string::npos) << name << ": " << status.message();
  }
}

TEST(FieldText, ReadsNothingBehindTheEndOfANumber) {
  // In memory that ends with the text: AddressSanitizer sees who looks farther.
  for (const std::string text : {"", "-", "1e", "+1", "nonsense", "1.5x", "1e400", "-1e400", "--1", ".", "1e-", "e5"}) {
    const std::vector<char> exact(text.begin(), text.end());
    Everything message;
    const auto& field = *FindField(*Everything::descriptor(), "real_double");
    EXPECT_NE(SetScalarFromText(field, {exact.data(), exact.size()}, &message), "") << text;
  }
}

TEST(FieldText, UnderflowIsZeroAndOverflowIsRefused) {
  Everything message;
  for (const char* name : {"real", "real_double"}) {
    message.set_real(1), message.set_real_double(1);
    EXPECT_TRUE(Set(name, "-4.9e-5000", &message).ok());
    EXPECT_TRUE(Set(name, "0." + std::string(400, '0') + "1", &message).ok());
    EXPECT_FALSE(Set(name, "4.9e5000", &message).ok());
    EXPECT_FALSE(Set(name, "1" + std::string(400, '0'), &message).ok());
  }
  EXPECT_EQ(message.real(), 1);
  EXPECT_EQ(message.real_double(), 0);
  EXPECT_TRUE(Set("real", "1e-60", &message).ok());
  EXPECT_EQ(message.real(), 0);
  EXPECT_FALSE(Set("real", "1e60", &message).ok());
}

struct GoodField {
  const char* name;
  const char* text;
  const char* expected;  ///< text format
};

TEST(FieldText, SetsEveryFieldWithATextForm) {
  const GoodField cases[] = {
      {"i32", "-7", "i32: -7"},
      {"u64", "18446744073709551615", "u64: 18446744073709551615"},
      {"real_double", "1e-3", "real_double: 0.001"},
      {"flag", "true", "flag: true"},
      {"text", "as it is, \"quoted\"", R"(text: "as it is, \"quoted\"")"},
      {"text", "", ""},
      {"raw", "_-8", R"(raw: "\377\357")"},
      {"shade", "DARK", "shade: DARK"},
      {"shade", "1", "shade: LIGHT"},
      {"many_i64", "5", "many_i64: 5"},
      {"child.child.i32", "5", "child {child {i32: 5}}"},
      {"boxed", "0", "boxed {value: 0}"},
      {"boxed_text", "x y", R"(boxed_text {value: "x y"})"},
      {"time", "1970-01-01T00:00:05Z", "time {seconds: 5}"},
      {"span", "1.5s", "span {seconds: 1 nanos: 500000000}"},
      {"mask", "aB,c.dE", R"(mask {paths: ["a_b", "c.d_e"]})"},
  };
  for (const GoodField& c : cases) {
    Everything got, expected;
    const Status status = Set(c.name, c.text, &got);
    EXPECT_TRUE(status.ok()) << c.name << ": " << status.message();
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(c.expected, &expected)) << c.expected;
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(expected, got)) << got.ShortDebugString();
  }
}

TEST(FieldText, ErrorsNameTheFieldAndItsType) {
  const std::pair<const char*, const char*> cases[] = {
      {"i32", "2147483648"}, {"i32", "1.5"},  {"i32", " 1"},    {"i32", ""},       {"u32", "-1"}, {"real", "1e39"},
      {"real", "0x1"},       {"flag", "1"},   {"flag", "TRUE"}, {"shade", "PINK"}, {"raw", "@@"}, {"text", "\xFF"},
      {"time", "soon"},      {"span", "1.5"}, {"child", "{}"},  {"counts", "a"},   {"any", "x"},
  };
  for (const auto& [name, text] : cases) {
    Everything message;
    const Status status = Set(name, text, &message);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << name << " = " << text;
    EXPECT_NE(status.message().find(name), std::string::npos) << status.message();
  }
}

TEST(FieldText, AppendsToLists) {
  Everything message;
  for (const char* text : {"1", "2"}) ASSERT_TRUE(Set("many_i64", text, &message).ok());
  EXPECT_EQ(message.many_i64_size(), 2);
  EXPECT_EQ(SetScalarFromText(*FindField(*Everything::descriptor(), "many_i64"), "3", &message), "");
  EXPECT_EQ(message.many_i64(2), 3);
  EXPECT_NE(SetScalarFromText(*FindField(*Everything::descriptor(), "many_i64"), "x", &message), "");
  EXPECT_EQ(message.many_i64_size(), 3);
}

TEST(FieldText, SnakeCaseIsItsOwnSnakeCase) {
  for (const char* name : {"mapFromSubmap", "map_from_submap"}) EXPECT_EQ(ToSnakeCase(name), "map_from_submap");
  for (const char* name : {"", "a", "a1b", "translation_m"}) EXPECT_EQ(ToSnakeCase(name), name);
}

TEST(FieldText, AMaskIsItsListOfNames) {
  google::protobuf::FieldMask mask;
  SetFieldMask("displayName,a.bC", &mask);
  EXPECT_EQ(std::vector<std::string>(mask.paths().begin(), mask.paths().end()),
            (std::vector<std::string>{"display_name", "a.b_c"}));
  google::protobuf::FieldMask empty;
  SetFieldMask("", &empty);
  EXPECT_EQ(empty.paths_size(), 0);
}

}  // namespace
}  // namespace dhpmap::json
