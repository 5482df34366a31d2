// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/error_body.h"

#include <google/protobuf/util/message_differencer.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/types/http_status.h"
#include "server/base/byte_budget.h"
#include "tests/unit/server/gateway/gateway_fixture.h"

namespace dhpmap::gateway {
namespace {

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
    const http::HttpAnswer answer = client->Ask("GET", "/v1/maps/home");
    EXPECT_EQ(answer.status, row.http_status) << row.grpc_code;
    const auto json = AsJson(answer.body);
    EXPECT_EQ(At(json, "code").number_value(), row.grpc_code);
    EXPECT_EQ(At(json, "message").string_value(), status.message());
    ASSERT_EQ(At(json, "details").list_value().values_size(), 1);
    const auto& detail = At(json, "details").list_value().values(0).struct_value();
    EXPECT_EQ(At(detail, "@type").string_value(), "type.googleapis.com/google.rpc.BadRequest");
    EXPECT_EQ(At(detail, "field_violations").list_value().values_size(), 1);

    const http::HttpAnswer binary = client->Ask("GET", "/v1/maps/home", "", {{"Accept", "application/x-protobuf"}});
    EXPECT_EQ(binary.status, row.http_status);
    EXPECT_EQ(binary.Header("Content-Type"), "application/x-protobuf");
    google::rpc::Status parsed;
    ASSERT_TRUE(parsed.ParseFromString(binary.body));
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(parsed, status));
  }
}

TEST_F(GatewayTest, UnknownAndMalformedDetailsAreHarmless) {
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

google::rpc::Status Parsed(const std::string& bytes) {
  google::rpc::Status status;
  EXPECT_TRUE(status.ParseFromString(bytes));
  return status;
}

TEST(ErrorBody, SomeReasonsHaveAnHttpStatusOfTheirOwn) {
  const Status too_large = ResourceExhausted("large").WithReason("BODY_TOO_LARGE");
  EXPECT_EQ(ErrorResponse(too_large, AnswerFormat::kJson).status, 413);
  EXPECT_EQ(ErrorResponse(TooManyBytes(), AnswerFormat::kJson).status, 429);
  const Status compacted = OutOfRange("old").WithReason("COMPACTED");
  EXPECT_EQ(ErrorResponse(ToRpcStatus(compacted), AnswerFormat::kJson).status, 410) << "an RPC's reasons, too";
  RpcStatus other = ToRpcStatus(compacted);
  other.code = static_cast<int>(StatusCode::kInternal);
  EXPECT_EQ(ErrorResponse(other, AnswerFormat::kJson).status, 500) << "but not of another code";
}

TEST(ErrorBody, DetailsAreJsonAndBothFormatsAgree) {
  const Status error = NotFound("no map \"a\"").WithReason("MAP_NOT_FOUND");
  EXPECT_EQ(ErrorResponse(error, AnswerFormat::kAny).body, ErrorResponse(error, AnswerFormat::kJson).body);
  const google::rpc::Status status = Parsed(ErrorResponse(error, AnswerFormat::kProtobuf).body);
  EXPECT_EQ(status.code(), 5);
  EXPECT_EQ(status.message(), "no map \"a\"");
  EXPECT_EQ(status.details_size(), 1);
}

TEST(ErrorBody, TheLastLineOfAStreamIsOneLine) {
  const std::string line = ErrorLine({.code = 15, .message = "two\nlines", .details = ""});
  EXPECT_EQ(line, "{\"error\":{\"code\":15,\"message\":\"two\\nlines\",\"details\":[]}}\n");
}

TEST(ErrorBody, DetailsThatContradictTheCodeAreDropped) {
  google::rpc::Status other;
  other.set_code(7);
  other.add_details()->set_type_url("type.googleapis.com/google.rpc.BadRequest");
  EXPECT_EQ(ErrorJson({.code = 5, .message = "gone", .details = other.SerializeAsString()}),
            R"({"code":5,"message":"gone","details":[]})");
}

}  // namespace
}  // namespace dhpmap::gateway
