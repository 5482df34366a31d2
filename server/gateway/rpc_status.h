// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/status.h"

namespace dhpmap::gateway {

/// The final status of an RPC: code, message, and google.rpc.Status in wire form (or empty) as gRPC carries it.
struct RpcStatus {
  int code = 0;
  std::string message;
  std::string details;

  [[nodiscard]] bool ok() const { return code == 0; }
};

/// With the reason as google.rpc.ErrorInfo and violations as google.rpc.BadRequest.
RpcStatus ToRpcStatus(const Status& status);

}  // namespace dhpmap::gateway
