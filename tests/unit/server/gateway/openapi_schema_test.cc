// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/openapi_schema.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include "json_test.pb.h"

namespace dhpmap::gateway {
namespace {

using google::protobuf::Struct;
using json::test::Everything;

std::string FieldSchema(const std::string& name) {
  OpenApiSchemas schemas;
  json::Builder out;
  schemas.WriteField(*Everything::descriptor()->FindFieldByName(name), &out);
  return out.Take();
}

Struct AllSchemas(OpenApiSchemas* schemas) {
  json::Builder out;
  out.BeginObject();
  schemas->WriteAll(&out);
  out.EndObject();
  Struct all;
  const std::string text = out.Take();
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &all).ok()) << text;
  return all;
}

TEST(OpenApiSchemas, DescribesFieldsAsInJson) {
  const std::pair<const char*, const char*> cases[] = {
      {"i32", R"({"type":"integer","format":"int32"})"},
      {"i64", R"({"type":"string","format":"int64"})"},  // a string, as it is written
      {"u64", R"({"type":"string","format":"uint64"})"},
      {"f64", R"({"type":"string","format":"uint64"})"},
      {"u32", R"({"type":"integer","format":"int64","minimum":0,"maximum":4294967295})"},
      {"real", R"({"type":"number","format":"float"})"},
      {"flag", R"({"type":"boolean"})"},
      {"raw", R"({"type":"string","format":"byte"})"},
      {"shade", R"({"$ref":"#/components/schemas/dhpmap.json.test.Shade"})"},
      {"child", R"({"$ref":"#/components/schemas/dhpmap.json.test.Everything"})"},
      {"many_i64", R"({"type":"array","items":{"type":"string","format":"int64"}})"},
      {"counts", R"({"type":"object","additionalProperties":{"type":"integer","format":"int32"}})"},
      {"time", R"({"type":"string","format":"date-time"})"},
      {"times", R"({"type":"array","items":{"type":"string","format":"date-time"}})"},
      {"boxed", R"({"type":"integer","nullable":true})"},
      {"value", "{}"},
  };
  for (const auto& [name, schema] : cases) EXPECT_EQ(FieldSchema(name), schema) << name;
}

TEST(OpenApiSchemas, WritesReferencedSchemasOnly) {
  OpenApiSchemas nothing;
  EXPECT_EQ(AllSchemas(&nothing).fields_size(), 0);
  OpenApiSchemas schemas;
  json::Builder out;
  schemas.WriteMessage(*json::test::Part::descriptor(), &out);
  const Struct all = AllSchemas(&schemas);
  EXPECT_EQ(all.fields_size(), 1);
  EXPECT_EQ(all.fields().count("dhpmap.json.test.Part"), 1u);
}

TEST(OpenApiSchemas, ARecursiveMessageIsWrittenOnceWithItsReferences) {
  OpenApiSchemas schemas;
  json::Builder out;
  schemas.WriteMessage(*Everything::descriptor(), &out);
  const Struct all = AllSchemas(&schemas);
  EXPECT_EQ(all.fields_size(), 2) << "itself and its enum: well-known types are written where they are used";
  const Struct& shade = all.fields().at("dhpmap.json.test.Shade").struct_value();
  EXPECT_EQ(shade.fields().at("enum").list_value().values_size(), 3);
  const Struct& everything = all.fields().at("dhpmap.json.test.Everything").struct_value();
  EXPECT_EQ(everything.fields().at("properties").struct_value().fields_size(), Everything::descriptor()->field_count());
  EXPECT_EQ(everything.fields().at("description").string_value(), "At most one of choice_text, choice_child.");
}

}  // namespace
}  // namespace dhpmap::gateway
