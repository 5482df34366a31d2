// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "google/rpc/status.pb.h"
#include "mapping/base/status.h"

namespace dhpmap {

/// The error as both doors send it: the reason as google.rpc.ErrorInfo of domain "dhpmap", the violations as
/// google.rpc.BadRequest, of which the first also stands in the message. What is not UTF-8 (a message may quote what a
/// client sent) has '?' in its place.
google::rpc::Status ToProto(const Status& status);

/// What the details of an error say.
struct ErrorDetails {
  std::string reason;  ///< as sent, for it may come from a newer server; empty: none
  std::vector<FieldViolation> violations;
};
/// Of a serialised google.rpc.Status, as gRPC carries it; empty if it is none.
ErrorDetails ReadErrorDetails(const std::string& bytes);

}  // namespace dhpmap
