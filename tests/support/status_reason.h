// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace dhpmap::testing {

/// The reason that the server gives in a status of gRPC; empty if there is none, as when the connection is lost.
inline std::string ReasonOf(const grpc::Status& status) {
  google::rpc::Status proto;
  google::rpc::ErrorInfo info;
  if (!proto.ParseFromString(status.error_details())) return {};
  for (const auto& detail : proto.details()) {
    if (detail.UnpackTo(&info)) return info.reason();
  }
  return {};
}

}  // namespace dhpmap::testing
