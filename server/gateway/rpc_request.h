// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "mapping/base/result.h"
#include "server/gateway/media_type.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/transcoder.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

/// One request, parsed up to its body.
struct RpcRequest {
  /// Errors as in MakeCallOptions and RequestTranscoder::Make; reasons UNSUPPORTED_MEDIA_TYPE; NOT_ACCEPTABLE, except
  /// for files, whose type is not known yet; BODY_TOO_LARGE if the announced size of one message exceeds
  /// MostRequestBytes of `most_bytes`.
  static Result<RpcRequest> Make(const http::RequestHead& head, RouteMatch match, std::string_view query,
                                 std::size_t most_bytes);

  const Route* route;
  RequestTranscoder transcoder;
  BodyFormat body_format;
  bool is_one_value;  ///< the Content-Type stands for one JSON value, which the client may ignore
  AnswerFormat answer_format;
  std::string accept;         ///< header Accept
  std::string if_none_match;  ///< header If-None-Match
  bool takes_gzip;            ///< for files, by Accept-Encoding
  CallOptions call;
  std::size_t max_body_bytes;   ///< of one message, for client streams
  std::size_t announced_bytes;  ///< Content-Length; 0 if missing
  bool is_head;
  std::string file_stem;  ///< file name for an answer that is a file, without extension
};

}  // namespace dhpmap::gateway
