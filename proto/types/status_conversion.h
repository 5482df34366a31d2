// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "google/rpc/status.pb.h"
#include "mapping/base/status.h"

namespace dhpmap {

/// The error as both doors send it: the reason as google.rpc.ErrorInfo of domain "dhpmap", the violations as
/// google.rpc.BadRequest, the first also in the message, and of the metadata
/// `retry_after_s` also google.rpc.RetryInfo. Replaces bytes that are not UTF-8 by '?' (messages may quote
/// clients).
google::rpc::Status ToProto(const Status& status);

/// Details of an error.
struct ErrorDetails {
  std::string reason;  ///< as sent, possibly by a newer server; may be empty
  std::vector<FieldViolation> violations;
};
/// From a serialised google.rpc.Status, as in gRPC trailers; empty if malformed.
ErrorDetails ReadErrorDetails(const std::string& bytes);

}  // namespace dhpmap
