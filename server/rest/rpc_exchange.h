// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "server/rest/http_message.h"
#include "server/rest/media_type.h"
#include "server/rest/rpc_call.h"
#include "server/rest/transcoder.h"

namespace dhpmap::rest {

/// What one request asks for, understood up to its body.
struct RpcRequest {
  const Route* route;
  RequestTranscoder transcoder;
  BodyFormat body_format;
  AnswerFormat answer_format;
  CallOptions call;
  std::size_t max_body_bytes;  ///< of one message, where the client streams
  bool is_head;
  std::string file_stem;  ///< name of the answer if it is a file, without its extension
};

/// Collects the body, makes one call, answers with its response.
std::shared_ptr<Exchange> MakeUnaryExchange(RpcRequest request, RpcCaller* caller,
                                            std::shared_ptr<Responder> responder);

/// For streams in either direction: messages go to the RPC as they arrive, and answers to the client as they come; each
/// side waits for the other. Answers are NDJSON, length-delimited messages, or the parts of a file put together.
std::shared_ptr<Exchange> MakeStreamExchange(RpcRequest request, RpcCaller* caller,
                                             std::shared_ptr<Responder> responder);

/// 413.
HttpResponse BodyTooLarge(std::size_t max_bytes, AnswerFormat format);

}  // namespace dhpmap::rest
