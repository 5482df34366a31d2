// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace dhpmap::testing {

/// The first detail of a kind that a status has, such as google::rpc::ErrorInfo; an empty one if there is none, as when
/// the connection is lost.
template <typename Detail>
Detail DetailOf(const google::rpc::Status& status) {
  for (const auto& detail : status.details()) {
    if (Detail found; detail.UnpackTo(&found)) return found;
  }
  return {};
}
template <typename Detail>
Detail DetailOf(const grpc::Status& status) {
  google::rpc::Status proto;
  return proto.ParseFromString(status.error_details()) ? DetailOf<Detail>(proto) : Detail();
}

inline google::rpc::ErrorInfo ErrorInfoOf(const grpc::Status& status) {
  return DetailOf<google::rpc::ErrorInfo>(status);
}
/// The reason that the server gives; empty if there is none.
inline std::string ReasonOf(const grpc::Status& status) { return ErrorInfoOf(status).reason(); }

inline std::string ReasonOf(const google::rpc::Status& status) {
  return DetailOf<google::rpc::ErrorInfo>(status).reason();
}

/// The field that is violated first; empty if none is.
template <typename Status>
std::string BadFieldOf(const Status& status) {
  const auto bad = DetailOf<google::rpc::BadRequest>(status);
  return bad.field_violations().empty() ? "" : bad.field_violations(0).field();
}
/// The same with what is wrong with it: "points_m[0] is not finite".
template <typename Status>
std::string ViolationOf(const Status& status) {
  const auto bad = DetailOf<google::rpc::BadRequest>(status);
  if (bad.field_violations().empty()) return "";
  return bad.field_violations(0).field() + " " + bad.field_violations(0).description();
}

}  // namespace dhpmap::testing
