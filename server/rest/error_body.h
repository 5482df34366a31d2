// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "server/rest/http_message.h"
#include "server/rest/media_type.h"

namespace dhpmap::rest {

/// What an RPC ended with: code, message, and google.rpc.Status in wire form (or nothing) as gRPC carries it.
struct RpcStatus {
  int code = 0;
  std::string message;
  std::string details;

  [[nodiscard]] bool ok() const { return code == 0; }
};

/// With reason as google.rpc.ErrorInfo and violations as google.rpc.BadRequest.
RpcStatus ToRpcStatus(const Status& status);

/// {"code":5,"message":"...","details":[{"@type":...}]}
std::string ErrorJson(const RpcStatus& status);

/// The whole answer, as google.rpc.Status in JSON or protobuf; `http_status` 0 takes that of the code.
HttpResponse ErrorResponse(const RpcStatus& status, AnswerFormat format, int http_status = 0);
HttpResponse ErrorResponse(const Status& status, AnswerFormat format, int http_status = 0);

/// {"error":{...}}, the last line of an NDJSON answer.
std::string ErrorLine(const RpcStatus& status);

}  // namespace dhpmap::rest
