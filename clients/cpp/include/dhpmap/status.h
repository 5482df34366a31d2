// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap::client {

/// google.rpc.Code, with the same numbers.
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

/// "NOT_FOUND".
std::string_view StatusCodeName(StatusCode code);

/// A wrong field of a request, by its dotted path.
struct FieldViolation {
  std::string field;
  std::string description;
};

/// The result of a call: OK or an error. The only error type of this library. A value.
struct [[nodiscard]] Status {
  StatusCode code = StatusCode::kOk;
  std::string message;                          ///< for people
  std::string reason;                           ///< for programs, such as "MAP_NOT_FOUND"; may be empty
  std::vector<FieldViolation> violations;       ///< for InvalidArgument: every wrong field
  std::map<std::string, std::string> metadata;  ///< details of the reason, such as {"merged_into", ...}

  [[nodiscard]] bool ok() const { return code == StatusCode::kOk; }
  /// "INVALID_ARGUMENT: message (REASON)".
  [[nodiscard]] std::string ToString() const;
};

}  // namespace dhpmap::client
