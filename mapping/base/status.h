// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mapping/base/reason.h"
#include "mapping/base/status_code.h"

namespace dhpmap {

/// One offending field of a request or a config, by its dotted path.
struct FieldViolation {
  std::string field;
  std::string description;
};

/// Outcome of an operation that can fail. The message names the problem, the id and the value; it never holds SQL or a
/// server-side path. Value type; thread-compatible.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(StatusCode code, std::string message) : code_(code), message_(std::move(message)) {}

  static Status Ok() { return {}; }

  [[nodiscard]] bool ok() const { return code_ == StatusCode::kOk; }
  [[nodiscard]] StatusCode code() const { return code_; }
  [[nodiscard]] const std::string& message() const { return message_; }

  /// Machine-readable cause, or none.
  [[nodiscard]] Reason reason() const { return reason_; }
  [[nodiscard]] const std::vector<FieldViolation>& violations() const { return violations_; }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& metadata() const { return metadata_; }

  /// The reason must allow this code.
  Status& WithReason(Reason reason) &;
  Status&& WithReason(Reason reason) &&;
  Status&& WithViolation(std::string field, std::string description) &&;
  /// Details of the reason: google.rpc.ErrorInfo.metadata.
  Status&& WithMetadata(std::string key, std::string value) &&;
  void AddViolation(std::string field, std::string description);
  /// For logs only, not for clients: such as what an exception said.
  Status&& WithCause(std::string cause) &&;

  /// "INVALID_ARGUMENT: message [field: description; ...] (cause)" for logs and terminals.
  [[nodiscard]] std::string ToString() const;

 private:
  StatusCode code_ = StatusCode::kOk;
  std::string message_;
  Reason reason_;
  std::vector<FieldViolation> violations_;
  std::vector<std::pair<std::string, std::string>> metadata_;
  std::string cause_;
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
