// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/rpc_status.h"

#include <gtest/gtest.h>

#include "google/rpc/status.pb.h"
#include "proto/types/status_conversion.h"

namespace dhpmap::gateway {
namespace {

TEST(RpcStatus, HasReasonAndViolationsLikeAnRpc) {
  const Status error =
      InvalidArgument("the class is wrong").WithReason("BAD_EDIT").WithViolation("submap.class_id", "no such class");
  const RpcStatus status = ToRpcStatus(error);
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.code, 3);
  EXPECT_EQ(status.message, "the class is wrong: submap.class_id: no such class");
  const ErrorDetails details = ReadErrorDetails(status.details);
  EXPECT_EQ(details.reason, "BAD_EDIT");
  ASSERT_EQ(details.violations.size(), 1u);
  EXPECT_EQ(details.violations[0].field, "submap.class_id");
}

TEST(RpcStatus, DetailsContainTheSameCodeAndMessage) {
  const RpcStatus status = ToRpcStatus(NotFound("no map \xFF"));
  google::rpc::Status proto;
  ASSERT_TRUE(proto.ParseFromString(status.details));
  EXPECT_EQ(proto.code(), status.code);
  EXPECT_EQ(proto.message(), status.message);
  EXPECT_EQ(status.message, "no map ?") << "gRPC carries UTF-8 only";
}

TEST(RpcStatus, OkIsOk) { EXPECT_TRUE(ToRpcStatus(Status::Ok()).ok()); }

}  // namespace
}  // namespace dhpmap::gateway
