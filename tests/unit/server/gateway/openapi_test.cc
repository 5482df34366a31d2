// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/openapi.h"

#include <set>

#include "server/gateway/http_rule_router.h"
#include "tests/unit/server/gateway/gateway_fixture.h"

namespace dhpmap::gateway {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;

/// All "$ref" values, at any depth.
void CollectReferences(const Value& value, std::set<std::string>* out) {
  for (const auto& [key, member] : value.struct_value().fields()) {
    if (key == "$ref") out->insert(member.string_value());
    CollectReferences(member, out);
  }
  for (const Value& element : value.list_value().values()) CollectReferences(element, out);
}

TEST_F(GatewayTest, OpenApiHasEveryOperationAndResolvesItsReferences) {
  const http::HttpAnswer answer = client->Ask("GET", "/openapi.json");
  ASSERT_EQ(answer.status, 200);
  const Struct document = AsJson(answer.body);
  EXPECT_EQ(At(document, "openapi").string_value(), "3.0.3");
  EXPECT_EQ(At(document, "servers").list_value().values_size(), 1);
  EXPECT_TRUE(At(document, "security").has_list_value()) << "no authentication, and not by omission";
  const Struct& paths = At(document, "paths").struct_value();
  const Struct& schemas = At(At(document, "components").struct_value(), "schemas").struct_value();

  const auto router = HttpRuleRouter::FromLinkedServices();
  std::set<std::string> ids;
  for (const Route& route : router->routes()) {
    std::string method = route.http_method;
    for (char& c : method) c = static_cast<char>(c | 0x20);
    const OpenApiPath path = ToOpenApiPath(route);
    const Struct& operation = At(At(paths, path.text).struct_value(), method).struct_value();
    EXPECT_TRUE(ids.insert(At(operation, "operationId").string_value()).second) << "ids are unique";
    At(At(operation, "responses").struct_value(), "200");
    EXPECT_EQ(operation.fields().count("requestBody"), route.body == Route::Body::kNone ? 0u : 1u);
    std::set<std::string> in_path;
    for (const Value& parameter : At(operation, "parameters").list_value().values()) {
      const Struct& fields = parameter.struct_value();
      if (At(fields, "in").string_value() == "path") in_path.insert(At(fields, "name").string_value());
    }
    for (const auto& parameter : path.parameters) {
      EXPECT_EQ(in_path.count(parameter.name), 1u);
      EXPECT_NE(path.text.find('{' + parameter.name + '}'), std::string::npos);
    }
    EXPECT_EQ(in_path.size(), path.parameters.size()) << "names differ from each other";
  }
  Value whole;
  *whole.mutable_struct_value() = document;
  std::set<std::string> references;
  CollectReferences(whole, &references);
  EXPECT_GT(references.size(), 20u);
  const std::string prefix = "#/components/schemas/";
  for (const std::string& reference : references) {
    EXPECT_EQ(schemas.fields().count(reference.substr(prefix.size())), 1u) << reference;
  }
}

TEST(OpenApi, NamesWildcardsAfterTheirCollections) {
  const auto router = HttpRuleRouter::FromLinkedServices();
  const auto path = ToOpenApiPath(*router->Find("PATCH", "/v1/maps/a/submaps/1").route);
  EXPECT_EQ(path.text, "/v1/maps/{map}/submaps/{submap}");
  EXPECT_EQ(ToOpenApiPath(*router->Find("GET", "/v1/maps/a/stats").route).text, "/v1/maps/{map}/stats");
}

}  // namespace
}  // namespace dhpmap::gateway
