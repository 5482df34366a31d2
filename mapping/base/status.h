// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap {

/// The subset of google.rpc.Code that we use, with the same numbers (server/grpc checks that at compile time).
enum class StatusCode : int {
  kOk = 0,
  kCancelled = 1,
  kUnknown = 2,
  kInvalidArgument = 3,
  kDeadlineExceeded = 4,
  kNotFound = 5,
  kAlreadyExists = 6,
  kPermissionDenied = 7,
  kResourceExhausted = 8,
  kFailedPrecondition = 9,
  kAborted = 10,
  kOutOfRange = 11,
  kUnimplemented = 12,
  kInternal = 13,
  kUnavailable = 14,
  kDataLoss = 15,
  kUnauthenticated = 16,
};

std::string_view StatusCodeName(StatusCode code);

/// One offending field of a request or a config, by its dotted path.
struct FieldViolation {
  std::string field;
  std::string description;
};

/// Outcome of an operation that can fail. The message says what, which id and the value; it never holds SQL or a
/// server-side path that a client may not see. Value type; thread-compatible.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(StatusCode code, std::string message) : code_(code), message_(std::move(message)) {}

  static Status Ok() { return {}; }

  [[nodiscard]] bool ok() const { return code_ == StatusCode::kOk; }
  [[nodiscard]] StatusCode code() const { return code_; }
  [[nodiscard]] const std::string& message() const { return message_; }

  /// Machine-readable cause in UPPER_SNAKE (google.rpc.ErrorInfo.reason), or empty.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const std::vector<FieldViolation>& violations() const { return violations_; }

  Status& WithReason(std::string reason) &;
  Status&& WithReason(std::string reason) &&;
  Status&& WithViolation(std::string field, std::string description) &&;
  void AddViolation(std::string field, std::string description);

  /// "INVALID_ARGUMENT: message [field: description; ...]" for logs and terminals.
  [[nodiscard]] std::string ToString() const;

 private:
  StatusCode code_ = StatusCode::kOk;
  std::string message_;
  std::string reason_;
  std::vector<FieldViolation> violations_;
};

Status InvalidArgument(std::string message);
Status NotFound(std::string message);
Status AlreadyExists(std::string message);
Status FailedPrecondition(std::string message);
Status ResourceExhausted(std::string message);
Status OutOfRange(std::string message);
Status Aborted(std::string message);
Status Cancelled(std::string message);
Status Unavailable(std::string message);
Status DataLoss(std::string message);
Status Internal(std::string message);

}  // namespace dhpmap

/// Returns from the enclosing function if `expr` is not OK.
#define DHPMAP_RETURN_IF_ERROR(expr)                                                           \
  do {                                                                                         \
    if (::dhpmap::Status dhpmap_status_ = (expr); !dhpmap_status_.ok()) return dhpmap_status_; \
  } while (false)
