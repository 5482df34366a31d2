// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/status_conversion.h"

#include <gtest/gtest.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/types/http_status.h"

namespace dhpmap {
namespace {

TEST(StatusConversion, EveryCodeKeepsItsNumberMessageAndReason) {
  for (const StatusRow& row : StatusTable()) {
    if (row.code == StatusCode::kOk) continue;
    const grpc::Status status = ToGrpc(Status(row.code, "what happened").WithReason("NOT_STORED"));
    EXPECT_EQ(static_cast<int>(status.error_code()), row.grpc_code);
    EXPECT_EQ(status.error_message(), "what happened");
    google::rpc::Status details;
    ASSERT_TRUE(details.ParseFromString(status.error_details()));
    EXPECT_EQ(details.code(), row.grpc_code);
    google::rpc::ErrorInfo info;
    ASSERT_TRUE(details.details(0).UnpackTo(&info));
    EXPECT_EQ(info.reason(), "NOT_STORED");
  }
  EXPECT_TRUE(ToGrpc(Status::Ok()).ok());
}

}  // namespace
}  // namespace dhpmap
