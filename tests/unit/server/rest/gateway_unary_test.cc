// SPDX-License-Identifier: BSD-3-Clause
#include <google/protobuf/util/message_differencer.h>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "rest_test.pb.h"
#include "server/app/status_table.h"
#include "tests/unit/server/rest/gateway_fixture.h"

namespace dhpmap::rest {
namespace {

using test::Everything;

TEST_F(GatewayTest, GetPutsThePathIntoTheRequestAndAnswersJson) {
  v1::GetMapResponse response;
  response.mutable_map()->set_name("maps/home");
  response.set_revision(42);
  server.Set("GetMap", {.messages = {response.SerializeAsString()}});
  const HttpAnswer answer = client->Ask("GET", "/v1/maps/home");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.Header("Content-Type"), "application/json");
  const auto json = AsJson(answer.body);
  EXPECT_EQ(At(json, "revision").string_value(), "42");
  EXPECT_EQ(At(At(json, "map").struct_value(), "num_frames").string_value(), "0") << "zeros are shown";
  EXPECT_EQ(Heard<v1::GetMapRequest>().name(), "maps/home");
  EXPECT_EQ(server.WaitForCall().method, "/dhpmap.v1.MapService/GetMap");
}

TEST_F(GatewayTest, PostTakesJsonUnderCurlsDefaultContentType) {
  const std::string body = R"({"map_id":"home","config":{"voxelSizeM":0.05,"integration":{"carving":true}}})";
  for (const char* type :
       {"application/json", "application/x-www-form-urlencoded", "Application/JSON; charset=utf-8"}) {
    const HttpAnswer answer = client->Ask("POST", "/v1/maps", body, {{"Content-Type", type}});
    EXPECT_EQ(answer.status, 200) << answer.body;
  }
  EXPECT_EQ(client->Ask("POST", "/v1/maps", body).status, 200) << "no content type";
  const auto heard = Heard<v1::CreateMapRequest>(4);
  EXPECT_EQ(heard.map_id(), "home");
  EXPECT_DOUBLE_EQ(heard.config().voxel_size_m(), 0.05);
  EXPECT_TRUE(heard.config().integration().carving());
}

TEST_F(GatewayTest, LargeBodiesUnderCurlsDefaultTypeAreNoForms) {
  DHPMAP_SKIP_MEGABYTES();
  std::string body = R"({"xyz_m":[0)";
  while (body.size() < 300'000) body += ",0.25,-1.5,2";
  body += ",1,2]}";
  const HttpAnswer answer =
      client->Ask("POST", "/v1/maps/a:queryPoints", body, {{"Content-Type", "application/x-www-form-urlencoded"}});
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_GT(Heard<v1::QueryPointsRequest>().xyz_m_size(), 70'000);
}

TEST_F(GatewayTest, ProtobufGoesBothWays) {
  v1::QueryPointsRequest request;
  request.add_xyz_m(1.5f);
  request.set_map("maps/wrong");  // the path wins
  v1::QueryPointsResponse response;
  response.set_revision(7);
  server.Set("QueryPoints", {.messages = {response.SerializeAsString()}});
  const HttpAnswer answer =
      client->Ask("POST", "/v1/maps/right:queryPoints", request.SerializeAsString(),
                  {{"Content-Type", "application/x-protobuf"}, {"Accept", "application/x-protobuf"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.Header("Content-Type"), "application/x-protobuf");
  EXPECT_EQ(answer.body, response.SerializeAsString());
  const auto heard = Heard<v1::QueryPointsRequest>();
  EXPECT_EQ(heard.map(), "maps/right");
  EXPECT_EQ(heard.xyz_m(0), 1.5f);
}

TEST_F(GatewayTest, QueryParametersOfEveryKind) {
  const HttpAnswer answer =
      client->Ask("GET",
                  "/test/a%20b:query?i32=-3&i64=9007199254740993&flag=true&shade=DARK&manyShade=LIGHT&many_shade=2"
                  "&real=1.5&many_real=1,2.5,-3&many_real=4e1&many_i64=5&many_text=x,y&many_text=z&raw=_-8"
                  "&child.child.i32=8&child.realDouble=0.25&boxed=6&boxed_text=hi%20there&mask=aB,c.d"
                  "&time=1970-01-01T00:00:05Z&span=1.5s&maybe=0");
  EXPECT_EQ(answer.status, 200) << answer.body;
  Everything expected;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(
                  R"({"text":"a b","i32":-3,"i64":"9007199254740993","flag":true,"shade":"DARK",
                      "many_shade":["LIGHT","DARK"],"real":1.5,"many_real":[1,2.5,-3,40],"many_i64":[5],
                      "many_text":["x,y","z"],"raw":"_-8","child":{"child":{"i32":8},"real_double":0.25},"boxed":6,
                      "boxed_text":"hi there","mask":"aB,c.d","time":"1970-01-01T00:00:05Z","span":"1.5s","maybe":0})",
                  &expected)
                  .ok());
  const auto heard = Heard<Everything>();
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(expected, heard)) << heard.DebugString();
}

TEST_F(GatewayTest, BadQueryParametersAreNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"/v1/maps/a/submaps?nothing=1", "'nothing'"},
      {"/v1/maps/a/submaps?region.min_m.q=1", "'region.min_m.q'"},
      {"/v1/maps/a/submaps?parent=maps/b", "the path gives this field"},
      {"/v1/maps/a/submaps?class_ids=1,x", "class_ids: expected an integer"},
      {"/v1/maps/a/submaps?kind=CHAIR", "kind: expected a value of"},
      {"/v1/maps/a/submaps?kind=THING&kind=STUFF", "given twice"},
      {"/v1/maps/a/submaps?near=5", "near.center_m"},
      {"/v1/maps/a/submaps?near.radius_m=1%2", "percent"},
      {"/v1/maps/a/submaps?class_names=%FF", "UTF-8"},
      {"/test/x:query?counts=1", "map"},
      {"/test/x:query?time=soon", "google.protobuf.Timestamp"},
  };
  for (const auto& [target, part] : cases) {
    const HttpAnswer answer = client->Ask("GET", target);
    EXPECT_EQ(answer.status, 400) << target;
    EXPECT_NE(answer.body.find(part), std::string::npos) << target << "\n" << answer.body;
    AsJson(answer.body);
  }
  EXPECT_EQ(client->Ask("POST", "/v1/maps?map_id=x", "{}").status, 400) << "fields belong into the body";
  EXPECT_EQ(client->Ask("PATCH", "/v1/maps/a/submaps/1?submap.class_id=3", "{}").status, 400);
  EXPECT_EQ(server.num_calls(), 0u);
}

std::vector<std::string> Paths(const v1::UpdateSubmapRequest& request) {
  return {request.update_mask().paths().begin(), request.update_mask().paths().end()};
}

TEST_F(GatewayTest, PatchWithoutMaskChangesWhatItsBodyNames) {
  ASSERT_EQ(client
                ->Ask("PATCH", "/v1/maps/a/submaps/3",
                      R"({"displayName":"","map_from_submap":{"translationM":{"x":1,"y":0}},"etag":"q","name":"no"})")
                .status,
            200);
  const auto heard = Heard<v1::UpdateSubmapRequest>();
  EXPECT_EQ(heard.submap().name(), "maps/a/submaps/3");
  EXPECT_EQ(heard.submap().etag(), "q");
  EXPECT_EQ(Paths(heard), (std::vector<std::string>{"display_name", "map_from_submap.translation_m.x",
                                                    "map_from_submap.translation_m.y"}));
}

TEST_F(GatewayTest, PatchWithAMaskInTheQueryKeepsIt) {
  ASSERT_EQ(client
                ->Ask("PATCH", "/v1/maps/a/submaps/3?updateMask=displayName,class_id",
                      R"({"display_name":"x","map_from_submap":{}})")
                .status,
            200);
  EXPECT_EQ(Paths(Heard<v1::UpdateSubmapRequest>()), (std::vector<std::string>{"display_name", "class_id"}));
}

TEST_F(GatewayTest, PatchWithAProtobufBodyLeavesTheMaskToTheServer) {
  v1::Submap body;
  body.set_display_name("x");
  ASSERT_EQ(
      client
          ->Ask("PATCH", "/v1/maps/a/submaps/3", body.SerializeAsString(), {{"Content-Type", "application/x-protobuf"}})
          .status,
      200);
  const auto heard = Heard<v1::UpdateSubmapRequest>();
  EXPECT_EQ(heard.submap().display_name(), "x");
  EXPECT_EQ(heard.submap().name(), "maps/a/submaps/3");
  EXPECT_FALSE(heard.has_update_mask());
}

TEST_F(GatewayTest, BodiesAndAnswersThatAreOneField) {
  Everything response;
  response.add_many_text("p");
  response.mutable_child()->set_i32(4);
  server.Set("Texts", {.messages = {response.SerializeAsString()}});
  server.Set("Whole", {.messages = {response.SerializeAsString()}});
  EXPECT_EQ(client->Ask("POST", "/test/texts", R"("only a string")").body, "[\"p\"]\n");
  EXPECT_EQ(Heard<Everything>().text(), "only a string");
  const auto child = AsJson(client->Ask("POST", "/test/whole/9/true", R"({"i32":1})").body);
  EXPECT_EQ(At(child, "i32").number_value(), 4);
  EXPECT_EQ(Heard<Everything>(2).i32(), 9);
  EXPECT_EQ(client->Ask("PUT", "/test/x", R"([{"i32":1},{"i32":2}])").status, 200);
  EXPECT_EQ(Heard<Everything>(3).many_child_size(), 2);
  EXPECT_EQ(client->Ask("POST", "/test/whole/9/maybe", "{}").status, 400) << "a path value of the wrong type";
}

TEST_F(GatewayTest, EveryStatusCodeHasItsHttpStatusAndDetails) {
  for (const StatusRow& row : StatusTable()) {
    if (row.code == StatusCode::kOk) continue;
    google::rpc::Status status;
    status.set_code(row.grpc_code);
    status.set_message("why \"it\" failed");
    google::rpc::BadRequest bad;
    bad.add_field_violations()->set_field("name");
    status.add_details()->PackFrom(bad);
    server.Set("GetMap", {.status = grpc::Status(static_cast<grpc::StatusCode>(row.grpc_code), status.message(),
                                                 status.SerializeAsString())});
    const HttpAnswer answer = client->Ask("GET", "/v1/maps/home");
    EXPECT_EQ(answer.status, row.http_status) << row.grpc_code;
    const auto json = AsJson(answer.body);
    EXPECT_EQ(At(json, "code").number_value(), row.grpc_code);
    EXPECT_EQ(At(json, "message").string_value(), status.message());
    ASSERT_EQ(At(json, "details").list_value().values_size(), 1);
    const auto& detail = At(json, "details").list_value().values(0).struct_value();
    EXPECT_EQ(At(detail, "@type").string_value(), "type.googleapis.com/google.rpc.BadRequest");
    EXPECT_EQ(At(detail, "field_violations").list_value().values_size(), 1);

    const HttpAnswer binary = client->Ask("GET", "/v1/maps/home", "", {{"Accept", "application/x-protobuf"}});
    EXPECT_EQ(binary.status, row.http_status);
    EXPECT_EQ(binary.Header("Content-Type"), "application/x-protobuf");
    google::rpc::Status parsed;
    ASSERT_TRUE(parsed.ParseFromString(binary.body));
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(parsed, status));
  }
}

TEST_F(GatewayTest, DetailsOfUnknownTypeAndGarbageAreSurvived) {
  google::rpc::Status status;
  status.set_code(5);
  auto* any = status.add_details();
  any->set_type_url("type.googleapis.com/no.such.Type");
  any->set_value("\xFF\x01");
  server.Set("GetMap", {.status = grpc::Status(grpc::NOT_FOUND, "gone \xFF", status.SerializeAsString())});
  EXPECT_EQ(client->Ask("GET", "/v1/maps/a").body,
            "{\"code\":5,\"message\":\"gone ?\",\"details\":[{\"@type\":\"type.googleapis.com/no.such.Type\","
            "\"value\":\"/wE=\"}]}\n");
  server.Set("GetMap", {.status = grpc::Status(grpc::NOT_FOUND, "gone", "garbage \xFF")});
  EXPECT_EQ(client->Ask("GET", "/v1/maps/a").body, "{\"code\":5,\"message\":\"gone\",\"details\":[]}\n");
}

TEST_F(GatewayTest, MalformedJsonIsAnsweredWithItsPlace) {
  const HttpAnswer answer = client->Ask("POST", "/v1/maps", "{\"map_id\":\"x\",\n oops}");
  EXPECT_EQ(answer.status, 400);
  const auto json = AsJson(answer.body);
  EXPECT_EQ(At(json, "code").number_value(), 3);
  EXPECT_NE(At(json, "message").string_value().find("line 2, column 2 (byte 16)"), std::string::npos) << answer.body;
  EXPECT_NE(answer.body.find("MALFORMED_JSON"), std::string::npos);
  const HttpAnswer field = client->Ask("POST", "/v1/maps", R"({"config":{"voxel_size_m":"big"}})");
  EXPECT_NE(field.body.find(R"("field":"config.voxel_size_m")"), std::string::npos) << field.body;
}

TEST_F(GatewayTest, MalformedProtobufIsRefused) {
  const HttpAnswer answer =
      client->Ask("POST", "/v1/maps", "\xFF\xFF\xFF", {{"Content-Type", "application/x-protobuf"}});
  EXPECT_EQ(answer.status, 400);
  EXPECT_NE(answer.body.find("dhpmap.v1.CreateMapRequest"), std::string::npos);
}

TEST_F(GatewayTest, UnknownPathsMethodsAndTypes) {
  const HttpAnswer unknown = client->Ask("GET", "/v1/nothing/here");
  EXPECT_EQ(unknown.status, 404);
  EXPECT_EQ(At(AsJson(unknown.body), "code").number_value(), 5);
  EXPECT_EQ(client->Ask("POST", "/v1/maps/a:finishMaping", "{}").status, 404) << "misspelt verb";

  const HttpAnswer wrong = client->Ask("PUT", "/v1/maps/a");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(wrong.Header("Allow"), "DELETE, GET, HEAD");
  const HttpAnswer options = client->Ask("OPTIONS", "/v1/maps");
  EXPECT_EQ(options.status, 204);
  EXPECT_EQ(options.Header("Allow"), "GET, HEAD, POST");

  EXPECT_EQ(client->Ask("POST", "/v1/maps", "<map/>", {{"Content-Type", "text/xml"}}).status, 415);
  EXPECT_EQ(client->Ask("POST", "/v1/maps", "{}", {{"Content-Encoding", "gzip"}}).status, 415);
  EXPECT_EQ(client->Ask("POST", "/v1/maps", "{}", {{"Content-Type", "application/x-protobuf-stream"}}).status, 415);
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "{}").status, 400) << "a GET with a body";
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(GatewayTest, ForwardsMetadataAndGivesEveryRequestAnId) {
  const HttpAnswer answer = client->Ask(
      "GET", "/v1/maps", "",
      {{"Authorization", "Bearer t"}, {"X-Request-ID", "r-1"}, {"TraceParent", "00-1-2-01"}, {"Cookie", "c=1"}});
  EXPECT_EQ(answer.Header("X-Request-Id"), "r-1");
  const HeardCall call = server.WaitForCall();
  EXPECT_EQ(call.metadata.find("authorization")->second, "Bearer t");
  EXPECT_EQ(call.metadata.find("x-request-id")->second, "r-1");
  EXPECT_EQ(call.metadata.find("traceparent")->second, "00-1-2-01");
  EXPECT_EQ(call.metadata.count("cookie"), 0u);
  const std::string first = client->Ask("GET", "/v1/maps").Header("X-Request-Id");
  const std::string second = client->Ask("GET", "/v1/maps").Header("X-Request-Id");
  EXPECT_FALSE(first.empty());
  EXPECT_NE(first, second);
}

TEST_F(GatewayTest, MetadataThatGrpcCannotCarryIsRefused) {
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "", {{"Authorization", "Bearer \xC3\xA4"}}).status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "", {{"X-Request-Id", "a\tb"}}).status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps").status, 200) << "the server is still up";
}

TEST_F(GatewayTest, TimeoutsBecomeDeadlines) {
  server.Set("GetMap", {.hang = true});
  const HttpAnswer late = client->Ask("GET", "/v1/maps/a", "", {{"X-Timeout-S", "0.05"}});
  EXPECT_EQ(late.status, 504);
  EXPECT_EQ(At(AsJson(late.body), "code").number_value(), 4);
  EXPECT_EQ(client->Ask("GET", "/v1/maps/a", "", {{"grpc-timeout", "50m"}}).status, 504);
  for (const char* bad : {"soon", "-1", "nan", "1S"}) {
    EXPECT_EQ(client->Ask("GET", "/v1/maps/a", "", {{"X-Timeout-S", bad}}).status, 400) << bad;
  }
  EXPECT_EQ(client->Ask("GET", "/v1/maps/a", "", {{"grpc-timeout", "5"}}).status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "", {{"X-Timeout-S", "1e300"}}).status, 200) << "as good as none";
}

TEST_F(GatewayTest, AClientThatGoesAwayCancelsTheRpc) {
  server.Set("GetMap", {.hang = true});
  client->SendRaw("GET /v1/maps/a HTTP/1.1\r\nHost: x\r\n\r\n");
  server.WaitForCall();
  client.reset();
  EXPECT_TRUE(server.WaitForCancel());
}

TEST_F(GatewayTest, RequestsOfForeignWebPagesAreRefused) {
  const auto ask = [&](const char* method, const char* origin) {
    return client->Ask(method, "/v1/maps", "", {{"Origin", origin}}).status;
  };
  EXPECT_EQ(ask("POST", "http://evil.example"), 403);
  EXPECT_EQ(ask("POST", "null"), 403);
  EXPECT_EQ(ask("POST", "http://localhost"), 200) << "the server's own pages";
  EXPECT_EQ(ask("GET", "http://evil.example"), 200) << "the browser keeps the answer from the page";
}

TEST_F(GatewayTest, AnAnswerOfTheWrongTypeIsAnInternalError) {
  server.Set("GetMap", {.messages = {"\xFF\xFF"}});
  const HttpAnswer answer = client->Ask("GET", "/v1/maps/a");
  EXPECT_EQ(answer.status, 500);
  EXPECT_EQ(At(AsJson(answer.body), "code").number_value(), 13);
}

}  // namespace
}  // namespace dhpmap::rest
