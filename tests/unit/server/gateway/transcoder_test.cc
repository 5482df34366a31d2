// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/transcoder.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/util/message_differencer.h>

#include "dhpmap/v1/submap_service.pb.h"
#include "json_test.pb.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

using json::test::Everything;

TEST_F(GatewayTest, QueryParametersOfEveryKind) {
  const http::HttpAnswer answer =
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
      {"/v1/maps/a/submaps?sphere=5", "sphere.center_m"},
      {"/v1/maps/a/submaps?sphere.radius_m=1%2", "percent"},
      {"/v1/maps/a/submaps?class_names=%FF", "UTF-8"},
      {"/test/x:query?counts=1", "map"},
      {"/test/x:query?time=soon", "google.protobuf.Timestamp"},
  };
  for (const auto& [target, part] : cases) {
    const http::HttpAnswer answer = client->Ask("GET", target);
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

TEST_F(GatewayTest, BodiesAndAnswersMayBeASingleField) {
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

TEST_F(GatewayTest, ErrorsOfMalformedJsonNameTheirPosition) {
  const http::HttpAnswer answer = client->Ask("POST", "/v1/maps", "{\"map_id\":\"x\",\n oops}");
  EXPECT_EQ(answer.status, 400);
  const auto json = AsJson(answer.body);
  EXPECT_EQ(At(json, "code").number_value(), 3);
  EXPECT_NE(At(json, "message").string_value().find("line 2, column 2 (byte 16)"), std::string::npos) << answer.body;
  EXPECT_NE(answer.body.find("MALFORMED_JSON"), std::string::npos);
  const http::HttpAnswer field = client->Ask("POST", "/v1/maps", R"({"config":{"voxel_size_m":"big"}})");
  EXPECT_NE(field.body.find(R"("field":"config.voxel_size_m")"), std::string::npos) << field.body;
}

TEST_F(GatewayTest, MalformedProtobufIsRefused) {
  const http::HttpAnswer answer =
      client->Ask("POST", "/v1/maps", "\xFF\xFF\xFF", {{"Content-Type", "application/x-protobuf"}});
  EXPECT_EQ(answer.status, 400);
  EXPECT_NE(answer.body.find("dhpmap.v1.CreateMapRequest"), std::string::npos);
}

/// The request's message, or the error.
template <typename Message>
Result<Message> Transcoded(const std::string& method, const std::string& path, const std::string& query,
                           const std::string& body, BodyFormat format = BodyFormat::kJson) {
  DHPMAP_ASSIGN_OR_RETURN(const RequestTranscoder transcoder, RequestTranscoder::Make(Matched(method, path), query));
  DHPMAP_ASSIGN_OR_RETURN(const std::string bytes, transcoder.ToRequest(format, body));
  Message message;
  EXPECT_TRUE(message.ParseFromString(bytes));
  return message;
}

TEST(RequestTranscoder, ThePathTakesPrecedenceOverTheBody) {
  const auto request = Transcoded<Everything>("POST", "/test/whole/9/true", "", R"({"i32":1,"flag":false,"text":"t"})");
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(request->i32(), 9);
  EXPECT_TRUE(request->flag());
  EXPECT_EQ(request->text(), "t");
}

TEST(RequestTranscoder, TheQueryFillsTheFieldsOutsideASingleFieldBody) {
  const auto request = Transcoded<Everything>("PUT", "/test/x", "i32=4&child.i32=5", R"([{"i32":1}])");
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(request->text(), "x");
  EXPECT_EQ(request->i32(), 4);
  EXPECT_EQ(request->child().i32(), 5);
  EXPECT_EQ(request->many_child_size(), 1);
  EXPECT_EQ(Transcoded<Everything>("PUT", "/test/x", "many_child.i32=4", "").status().code(),
            StatusCode::kInvalidArgument);
}

TEST(RequestTranscoder, NoBodyIsAnEmptyMessage) {
  for (const char* body : {"", " \r\n", "{}"})
    EXPECT_TRUE(Transcoded<Everything>("POST", "/test/count", "", body).ok());
  EXPECT_TRUE(Transcoded<Everything>("GET", "/test/x:query", "", "\n").ok());
  EXPECT_EQ(Transcoded<Everything>("GET", "/test/x:query", "", "{}").status().reason(), Reason("UNEXPECTED_BODY"));
}

TEST(RequestTranscoder, ASingleFieldBodyCannotBeProtobuf) {
  const auto request = Transcoded<Everything>("POST", "/test/texts", "", "abc", BodyFormat::kProtobuf);
  EXPECT_EQ(request.status().reason(), Reason("MALFORMED_PROTOBUF"));
}

TEST(RequestTranscoder, OneTranscoderMakesAllMessagesOfAStream) {
  const auto transcoder = RequestTranscoder::Make(Matched("POST", "/test/x:collect"), "");
  ASSERT_TRUE(transcoder.ok());
  EXPECT_EQ(transcoder->ToRequest(BodyFormat::kJson, R"({"i32":1})").value(),
            transcoder->ToRequest(BodyFormat::kJson, R"({"i32":1})").value());
  EXPECT_FALSE(transcoder->ToRequest(BodyFormat::kJson, R"({"i32":})").ok());
  EXPECT_TRUE(transcoder->ToRequest(BodyFormat::kJson, R"({"i32":2})").ok()) << "nothing is left of the bad one";
}

TEST(Varint, HasSevenBitsPerByteFromTheLowest) {
  for (const std::uint64_t size : {0ull, 1ull, 127ull, 128ull, 300ull, 1ull << 32, ~0ull}) {
    std::string bytes;
    AppendVarint(size, &bytes);
    google::protobuf::io::CodedInputStream input(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                                 static_cast<int>(bytes.size()));
    std::uint64_t back = 0;
    EXPECT_TRUE(input.ReadVarint64(&back));
    EXPECT_EQ(back, size);
    EXPECT_EQ(input.CurrentPosition(), static_cast<int>(bytes.size()));
  }
}

}  // namespace
}  // namespace dhpmap::gateway
