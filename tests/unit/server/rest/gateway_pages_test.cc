// SPDX-License-Identifier: BSD-3-Clause
#include <set>

#include "server/rest/http_rule_router.h"
#include "server/rest/openapi.h"
#include "tests/unit/server/rest/gateway_fixture.h"

namespace dhpmap::rest {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;

TEST_F(GatewayTest, HealthReadinessAndMetrics) {
  EXPECT_EQ(client->Ask("GET", "/healthz").body, "ok\n");
  EXPECT_EQ(client->Ask("GET", "/readyz").status, 200);
  is_ready = false;
  EXPECT_EQ(client->Ask("GET", "/readyz").status, 503);
  EXPECT_EQ(client->Ask("GET", "/healthz").status, 200) << "alive, but not ready";
  const HttpAnswer metrics = client->Ask("GET", "/metrics?x=1");
  EXPECT_EQ(metrics.body, "dhpmap_up 1\n");
  EXPECT_EQ(metrics.Header("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  const HttpAnswer wrong = client->Ask("POST", "/healthz", "{}");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(wrong.Header("Allow"), "GET, HEAD");
}

TEST_F(GatewayTest, TheIndexNamesEveryRpc) {
  const auto index = AsJson(client->Ask("GET", "/").body);
  const auto router = HttpRuleRouter::FromLinkedServices();
  EXPECT_EQ(static_cast<std::size_t>(At(index, "methods").list_value().values_size()), router->routes().size());
}

TEST_F(GatewayTest, HeadAnswersAsGetWithoutABody) {
  const HttpAnswer get = client->Ask("GET", "/openapi.json");
  const HttpAnswer head = client->Ask("HEAD", "/openapi.json");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.Header("Content-Length"), std::to_string(get.body.size()));
  EXPECT_EQ(client->Ask("GET", "/healthz").body, "ok\n") << "nothing was left on the connection";
}

/// All "$ref" values, wherever they are.
void CollectReferences(const Value& value, std::set<std::string>* out) {
  for (const auto& [key, member] : value.struct_value().fields()) {
    if (key == "$ref") out->insert(member.string_value());
    CollectReferences(member, out);
  }
  for (const Value& element : value.list_value().values()) CollectReferences(element, out);
}

TEST_F(GatewayTest, OpenApiHasEveryOperationAndResolvesItsReferences) {
  const HttpAnswer answer = client->Ask("GET", "/openapi.json");
  ASSERT_EQ(answer.status, 200);
  const Struct document = AsJson(answer.body);
  EXPECT_EQ(At(document, "openapi").string_value(), "3.0.3");
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
  EXPECT_EQ(ToOpenApiPath(*router->Find("GET", "/v1/maps/a:stats").route).text, "/v1/maps/{map}:stats");
}

TEST(Gateway, SaysWhyItCannotListen) {
  CannedServer server;
  GatewayOptions options;
  options.address = "127.0.0.1:0";
  auto first = Gateway::Start(options, server.channel(), {});
  ASSERT_TRUE(first.ok());
  options.address = "127.0.0.1:" + std::to_string((*first)->port());
  const auto second = Gateway::Start(options, server.channel(), {});
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), StatusCode::kUnavailable);
  EXPECT_NE(second.status().message().find(options.address), std::string::npos);
  for (const char* address : {"nonsense", "127.0.0.1", "127.0.0.1:x", "127.0.0.1:70000", "no.such.host:80", ""}) {
    options.address = address;
    const auto bad = Gateway::Start(options, server.channel(), {});
    ASSERT_FALSE(bad.ok()) << address;
    EXPECT_EQ(bad.status().code(), StatusCode::kInvalidArgument) << address;
  }
}

}  // namespace
}  // namespace dhpmap::rest
