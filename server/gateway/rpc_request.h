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

/// What one request asks for, understood up to its body.
struct RpcRequest {
  /// Errors as of MakeCallOptions and RequestTranscoder::Make; reasons UNSUPPORTED_MEDIA_TYPE; NOT_ACCEPTABLE,
  /// unless the answer is a file, whose type is not known yet; and BODY_TOO_LARGE for one message that is announced to
  /// be larger than MostRequestBytes of `most_bytes`.
  static Result<RpcRequest> Make(const http::RequestHead& head, RouteMatch match, std::string_view query,
                                 std::size_t most_bytes);

  const Route* route;
  RequestTranscoder transcoder;
  BodyFormat body_format;
  bool is_one_value;  ///< the body's type says that it is one JSON value (which it need not be)
  AnswerFormat answer_format;
  std::string accept;         ///< as the client sent it
  std::string if_none_match;  ///< likewise
  bool takes_gzip;            ///< of files, as it says in Accept-Encoding
  CallOptions call;
  std::size_t max_body_bytes;   ///< of one message, where the client streams
  std::size_t announced_bytes;  ///< size of the body as its head says; 0 if it does not
  bool is_head;
  std::string file_stem;  ///< name of the answer if it is a file, without its extension
};

}  // namespace dhpmap::gateway
