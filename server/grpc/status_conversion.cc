// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/status_conversion.h"

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

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
  google::rpc::Status details;
  details.set_code(static_cast<int>(status.code()));
  details.set_message(status.message());
  if (!status.reason().empty()) {
    google::rpc::ErrorInfo info;
    info.set_reason(status.reason());
    info.set_domain("dhpmap");
    details.add_details()->PackFrom(info);
  }
  if (!status.violations().empty()) {
    google::rpc::BadRequest bad;
    for (const FieldViolation& violation : status.violations()) {
      auto* field = bad.add_field_violations();
      field->set_field(violation.field);
      field->set_description(violation.description);
    }
    details.add_details()->PackFrom(bad);
  }
  return {static_cast<grpc::StatusCode>(status.code()), status.message(), details.SerializeAsString()};
}

}  // namespace dhpmap
