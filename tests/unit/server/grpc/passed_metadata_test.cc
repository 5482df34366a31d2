// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/passed_metadata.h"

#include <grpcpp/support/status.h>
#include <gtest/gtest.h>

#include <string>

#include "server/grpc/status_conversion.h"

namespace dhpmap {
namespace {

TEST(AsOwnerEndedTest, AnUnexplainedEndIsRetryable) {
  for (const grpc::StatusCode code : {grpc::UNAVAILABLE, grpc::CANCELLED, grpc::UNAUTHENTICATED}) {
    const grpc::Status status = AsOwnerEnded(grpc::Status(code, ""));
    EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE) << code;
    EXPECT_NE(status.error_details().find("OWNER_UNREACHABLE"), std::string::npos) << code;
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
