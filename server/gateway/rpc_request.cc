// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/rpc_request.h"

#include <algorithm>
#include <utility>

#include "server/base/request_limits.h"
#include "server/gateway/call_options.h"
#include "server/gateway/content_encoding.h"

namespace dhpmap::gateway {
namespace {

bool HasBody(const http::RequestHead& head) {
  return head.content_length.value_or(0) > 0 || !http::FindHeader(head.headers, "transfer-encoding").empty();
}

/// The last path value with unsafe characters replaced: "maps/home/submaps/3" -> "maps_home_submaps_3".
std::string FileStem(const RouteMatch& match) {
  std::string stem = match.values.empty() ? std::string() : match.values.back().substr(0, 128);
  std::replace_if(
      stem.begin(), stem.end(),
      [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.');
      },
      '_');
  return stem.empty() ? "download" : stem;
}

Status UnsupportedMediaType(std::string message) {
  return InvalidArgument(std::move(message)).WithReason("UNSUPPORTED_MEDIA_TYPE");
}

Result<BodyFormat> BodyFormatOf(const http::RequestHead& head, const Route& route) {
  const std::string_view content_type = http::FindHeader(head.headers, "content-type");
  auto format = FormatOfContentType(content_type);
  if (route.takes_file() && IsFileType(content_type)) format = BodyFormat::kFile;
  if (!HasBody(head) || route.body == Route::Body::kNone) format = format.value_or(BodyFormat::kJson);
  if (!format) {
    return UnsupportedMediaType("content type '" + std::string(content_type) +
                                "' is not taken: send application/json or " +
                                (route.takes_file() ? "application/octet-stream" : "application/x-protobuf"));
  }
  const std::string_view encoding = http::FindHeader(head.headers, "content-encoding");
  if (!encoding.empty() && !http::EqualsIgnoringCase(encoding, "identity")) {
    return UnsupportedMediaType("content encoding '" + std::string(encoding) + "' is not taken");
  }
  if (*format == BodyFormat::kDelimitedProtobuf && !route.client_streams()) {
    return UnsupportedMediaType("this RPC takes one message: send it as application/x-protobuf");
  }
  return *format;
}

}  // namespace

Result<RpcRequest> RpcRequest::Make(const http::RequestHead& head, RouteMatch match, std::string_view query,
                                    std::size_t most_bytes) {
  const Route& route = *match.route;
  const std::size_t max_body_bytes = MostRequestBytes(*route.method, most_bytes);
  DHPMAP_ASSIGN_OR_RETURN(const BodyFormat body_format, BodyFormatOf(head, route));
  const std::string_view accept = http::FindHeader(head.headers, "accept");
  if (!route.file && !IsAnyFormatAccepted(accept)) {
    return NotAcceptable(accept, std::string(kJsonType) + " or " + std::string(kProtobufType));
  }
  if (head.content_length.value_or(0) > max_body_bytes && !route.client_streams()) {
    return RequestTooLarge(*head.content_length, max_body_bytes);
  }
  DHPMAP_ASSIGN_OR_RETURN(CallOptions call, MakeCallOptions(route.rpc_path, head.headers));
  std::string file_stem = FileStem(match);
  DHPMAP_ASSIGN_OR_RETURN(RequestTranscoder transcoder, RequestTranscoder::Make(std::move(match), query));
  if (body_format == BodyFormat::kFile) transcoder.SetFileSize(head.content_length.value_or(0));
  DHPMAP_RETURN_IF_ERROR(transcoder.SetIfMatch(http::FindHeader(head.headers, "if-match")));
  transcoder.SetLastEventId(http::FindHeader(head.headers, "last-event-id"));
  return RpcRequest{.route = &route,
                    .transcoder = std::move(transcoder),
                    .body_format = body_format,
                    .is_one_value = IsOneJsonValue(http::FindHeader(head.headers, "content-type")),
                    .answer_format = FormatOfAccept(accept),
                    .accept = std::string(accept),
                    .if_none_match = std::string(http::FindHeader(head.headers, "if-none-match")),
                    .takes_gzip = TakesGzip(http::FindHeader(head.headers, "accept-encoding")),
                    .call = std::move(call),
                    .max_body_bytes = max_body_bytes,
                    .announced_bytes = static_cast<std::size_t>(head.content_length.value_or(0)),
                    .is_head = head.method == "HEAD",
                    .file_stem = std::move(file_stem)};
}

}  // namespace dhpmap::gateway
