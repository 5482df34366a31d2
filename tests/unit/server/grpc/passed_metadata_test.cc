// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/passed_metadata.h"

#include <grpcpp/support/status.h>
#include <gtest/gtest.h>

#include <string>

#include "server/grpc/status_conversion.h"

namespace dhpmap {
namespace {

TEST(AsOwnerEndedTest, AnUnexplainedEndIsRetryable) {
  for (const grpc::Status& said : {grpc::Status(grpc::UNAVAILABLE, ""), grpc::Status(grpc::CANCELLED, ""),
                                   grpc::Status(grpc::UNAUTHENTICATED, "BAD_CREDENTIAL: no such key")}) {
    const grpc::Status status = AsOwnerEnded(said);
    EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE) << said.error_code();
    EXPECT_NE(status.error_details().find("OWNER_UNREACHABLE"), std::string::npos) << said.error_code();
  }
}

TEST(AsOwnerEndedTest, TheEndOfTheCallersKeyIsPassedUnchanged) {
  const grpc::Status status =
      AsOwnerEnded(grpc::Status(grpc::UNAUTHENTICATED, "KEY_REVOKED: the key has been revoked"));
  EXPECT_EQ(status.error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(status.error_message(), "KEY_REVOKED: the key has been revoked");
}

TEST(PassesOnTest, FieldsThatGrpcCannotSendAreNotPassedOn) {
  EXPECT_TRUE(PassesOn("x-robot", "7 ~"));
  EXPECT_TRUE(PassesOn("x-robot-bin", "\x01\xff"));
  for (const char* value : {"\x01", "\x7f", "\xff", "tab\t"}) EXPECT_FALSE(PassesOn("x-robot", value)) << value;
  for (const char* key : {"", "X-Robot", "x robot", "x!", ":path", "x\xff"}) EXPECT_FALSE(PassesOn(key, "7")) << key;
}

TEST(PassesOnTest, CredentialsAndFieldsOfServersAreNotPassedOn) {
  for (const char* key :
       {"authorization", "cookie", "dhpmap-fleet-key", "dhpmap-principal", "dhpmap-relayed", "grpc-x"}) {
    EXPECT_FALSE(PassesOn(key, "7")) << key;
  }
}

TEST(AsOwnerEndedTest, TheOwnersStatusIsPassedUnchanged) {
  for (const Status& said : {NotFound("there is no map 'house'").WithReason("MAP_NOT_FOUND"), Cancelled("stopped")}) {
    const grpc::Status status = AsOwnerEnded(ToGrpc(said));
    EXPECT_EQ(status.error_code(), ToGrpc(said).error_code());
    EXPECT_EQ(status.error_details(), ToGrpc(said).error_details());
  }
  EXPECT_EQ(AsOwnerEnded(grpc::Status(grpc::DEADLINE_EXCEEDED, "late")).error_code(), grpc::DEADLINE_EXCEEDED);
}

}  // namespace
}  // namespace dhpmap
