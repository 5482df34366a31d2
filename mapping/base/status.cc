// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/status.h"

#include <cassert>

namespace dhpmap {

std::string_view StatusCodeName(StatusCode code) {
  switch (code) {
    case StatusCode::kOk: return "OK";
    case StatusCode::kCancelled: return "CANCELLED";
    case StatusCode::kUnknown: return "UNKNOWN";
    case StatusCode::kInvalidArgument: return "INVALID_ARGUMENT";
    case StatusCode::kDeadlineExceeded: return "DEADLINE_EXCEEDED";
    case StatusCode::kNotFound: return "NOT_FOUND";
    case StatusCode::kAlreadyExists: return "ALREADY_EXISTS";
    case StatusCode::kPermissionDenied: return "PERMISSION_DENIED";
    case StatusCode::kResourceExhausted: return "RESOURCE_EXHAUSTED";
    case StatusCode::kFailedPrecondition: return "FAILED_PRECONDITION";
    case StatusCode::kAborted: return "ABORTED";
    case StatusCode::kOutOfRange: return "OUT_OF_RANGE";
    case StatusCode::kUnimplemented: return "UNIMPLEMENTED";
    case StatusCode::kInternal: return "INTERNAL";
    case StatusCode::kUnavailable: return "UNAVAILABLE";
    case StatusCode::kDataLoss: return "DATA_LOSS";
    case StatusCode::kUnauthenticated: return "UNAUTHENTICATED";
  }
  return "UNKNOWN";
}

Status& Status::WithReason(Reason reason) & {
  assert(reason.Allows(code_));
  reason_ = reason;
  return *this;
}

Status&& Status::WithReason(Reason reason) && { return std::move(WithReason(reason)); }

Status&& Status::WithViolation(std::string field, std::string description) && {
  AddViolation(std::move(field), std::move(description));
  return std::move(*this);
}

Status&& Status::WithMetadata(std::string key, std::string value) && {
  metadata_.emplace_back(std::move(key), std::move(value));
  return std::move(*this);
}

Status&& Status::WithCause(std::string cause) && {
  cause_ = std::move(cause);
  return std::move(*this);
}

void Status::AddViolation(std::string field, std::string description) {
  constexpr std::size_t kMost = 64;  // of a table of a million bad rows nobody reads more
  if (violations_.size() < kMost) violations_.push_back({std::move(field), std::move(description)});
}

std::string Status::ToString() const {
  std::string text(StatusCodeName(code_));
  if (!message_.empty()) text += ": " + message_;
  for (std::size_t i = 0; i < violations_.size(); ++i) {
    text += (i == 0 ? " [" : "; ") + violations_[i].field + ": " + violations_[i].description;
  }
  if (!violations_.empty()) text += "]";
  if (!cause_.empty()) text += " (" + cause_ + ")";
  return text;
}

Status InvalidArgument(std::string message) { return {StatusCode::kInvalidArgument, std::move(message)}; }
Status NotFound(std::string message) { return {StatusCode::kNotFound, std::move(message)}; }
Status AlreadyExists(std::string message) { return {StatusCode::kAlreadyExists, std::move(message)}; }
Status FailedPrecondition(std::string message) { return {StatusCode::kFailedPrecondition, std::move(message)}; }
Status ResourceExhausted(std::string message) { return {StatusCode::kResourceExhausted, std::move(message)}; }
Status OutOfRange(std::string message) { return {StatusCode::kOutOfRange, std::move(message)}; }
Status Aborted(std::string message) { return {StatusCode::kAborted, std::move(message)}; }
Status Cancelled(std::string message) { return {StatusCode::kCancelled, std::move(message)}; }
Status Unavailable(std::string message) { return {StatusCode::kUnavailable, std::move(message)}; }
Status DataLoss(std::string message) { return {StatusCode::kDataLoss, std::move(message)}; }
Status Internal(std::string message) { return {StatusCode::kInternal, std::move(message)}; }

}  // namespace dhpmap
