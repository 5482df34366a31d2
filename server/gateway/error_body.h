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

/// The whole answer, as google.rpc.Status in JSON or protobuf, with the HTTP status of its reason, where that has one
/// of its own (410 for COMPACTED), or of its code. Retry-After as google.rpc.RetryInfo has it.
http::Response ErrorResponse(const RpcStatus& status, AnswerFormat format);
/// For what the gateway itself refuses.
http::Response ErrorResponse(const Status& status, AnswerFormat format);

/// {"error":{...}}, the last line of an NDJSON answer.
std::string ErrorLine(const RpcStatus& status);

}  // namespace dhpmap::gateway
