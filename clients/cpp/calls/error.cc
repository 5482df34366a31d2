// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/error.h"

#include <utility>

#include "google/rpc/error_details.pb.h"

namespace dhpmap::client {

Status Error(StatusCode code, std::string message) { return {code, std::move(message), {}, {}, {}}; }

Status BadArgument(std::string field, std::string description) {
  Status status = Error(StatusCode::kInvalidArgument, field + ": " + description);
  status.violations.push_back({std::move(field), std::move(description)});
  return status;
}

Status StatusOf(const google::rpc::Status& told) {
  Status status = Error(static_cast<StatusCode>(told.code()), told.message());
  for (const google::protobuf::Any& detail : told.details()) {
    google::rpc::ErrorInfo info;
    google::rpc::BadRequest bad;
    if (detail.UnpackTo(&info)) {
      status.reason = info.reason();
      status.metadata.insert(info.metadata().begin(), info.metadata().end());
    } else if (detail.UnpackTo(&bad)) {
      for (const auto& its : bad.field_violations()) status.violations.push_back({its.field(), its.description()});
    }
  }
  return status;
}

Status StatusOf(const grpc::Status& status, const std::string& address) {
  if (status.ok()) return {};
  google::rpc::Status told;
  if (status.error_details().empty() || !told.ParseFromString(status.error_details())) told.Clear();
  told.set_code(status.error_code());
  told.set_message(status.error_message());
  const bool is_told = told.details_size() > 0;
  // gRPC reports some lost connections this way.
  if (!is_told && told.code() == grpc::UNKNOWN && told.message().find("Stream removed") != std::string::npos) {
    told.set_code(grpc::UNAVAILABLE);
  }
  if (!is_told && !address.empty() && told.code() == grpc::UNAVAILABLE) {
    told.set_message(told.message() + "; is dhpmap-server running at " + address + "?");
  }
  return StatusOf(told);
}

bool IsPassing(const Status& status) {
  return status.code == StatusCode::kUnavailable ||
         (status.code == StatusCode::kAborted && status.reason == "SNAPSHOT_EXPIRED");
}

}  // namespace dhpmap::client
