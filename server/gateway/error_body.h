// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/status.h"
#include "server/gateway/media_type.h"
#include "server/gateway/rpc_status.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

/// {"code":5,"message":"...","details":[{"@type":...}]}
std::string ErrorJson(const RpcStatus& status);

/// A complete error answer: google.rpc.Status in JSON or protobuf. The HTTP status follows from the reason, if that has
/// its own (410 for COMPACTED), else from the code. Retry-After is taken from google.rpc.RetryInfo.
http::Response ErrorResponse(const RpcStatus& status, AnswerFormat format);
/// For errors of the gateway itself.
http::Response ErrorResponse(const Status& status, AnswerFormat format);

/// {"error":{...}}, the last line of an NDJSON answer.
std::string ErrorLine(const RpcStatus& status);

}  // namespace dhpmap::gateway
