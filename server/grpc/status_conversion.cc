// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/status_conversion.h"

#include "proto/types/status_conversion.h"

namespace dhpmap {
namespace {

constexpr bool SameNumber(StatusCode ours, grpc::StatusCode theirs) {
  return static_cast<int>(ours) == static_cast<int>(theirs);
}
static_assert(SameNumber(StatusCode::kOk, grpc::OK) && SameNumber(StatusCode::kCancelled, grpc::CANCELLED) &&
              SameNumber(StatusCode::kUnknown, grpc::UNKNOWN) &&
              SameNumber(StatusCode::kInvalidArgument, grpc::INVALID_ARGUMENT) &&
              SameNumber(StatusCode::kDeadlineExceeded, grpc::DEADLINE_EXCEEDED) &&
              SameNumber(StatusCode::kNotFound, grpc::NOT_FOUND) &&
              SameNumber(StatusCode::kAlreadyExists, grpc::ALREADY_EXISTS) &&
              SameNumber(StatusCode::kPermissionDenied, grpc::PERMISSION_DENIED) &&
              SameNumber(StatusCode::kResourceExhausted, grpc::RESOURCE_EXHAUSTED) &&
              SameNumber(StatusCode::kFailedPrecondition, grpc::FAILED_PRECONDITION) &&
              SameNumber(StatusCode::kAborted, grpc::ABORTED) &&
              SameNumber(StatusCode::kOutOfRange, grpc::OUT_OF_RANGE) &&
              SameNumber(StatusCode::kUnimplemented, grpc::UNIMPLEMENTED) &&
              SameNumber(StatusCode::kInternal, grpc::INTERNAL) &&
              SameNumber(StatusCode::kUnavailable, grpc::UNAVAILABLE) &&
              SameNumber(StatusCode::kDataLoss, grpc::DATA_LOSS) &&
              SameNumber(StatusCode::kUnauthenticated, grpc::UNAUTHENTICATED));

}  // namespace

grpc::Status ToGrpc(const Status& status) {
  if (status.ok()) return grpc::Status::OK;
  const google::rpc::Status proto = ToProto(status);
  return {static_cast<grpc::StatusCode>(proto.code()), proto.message(), proto.SerializeAsString()};
}

}  // namespace dhpmap
