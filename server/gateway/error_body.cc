// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/error_body.h"

#include <google/protobuf/util/json_util.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "mapping/base/utf8.h"
#include "proto/types/http_status.h"
#include "proto/types/status_conversion.h"
#include "server/json/base64.h"
#include "server/json/writer.h"

namespace dhpmap::gateway {
namespace {

google::rpc::Status Parsed(const RpcStatus& status) {
  google::rpc::Status proto;
  // Details that do not parse or contradict the code are dropped: code and message matter.
  if (!proto.ParseFromString(status.details) || proto.code() != status.code) proto.Clear();
  proto.set_code(status.code);
  proto.set_message(ToValidUtf8(status.message));
  return proto;
}

/// The reason of the RPC, if it is one of ours and fits the code.
Reason ReasonOf(const RpcStatus& status) {
  const Reason reason = Reason::Find(ReadErrorDetails(status.details).reason);
  return reason.Allows(static_cast<StatusCode>(status.code)) ? reason : Reason();
}

void AppendDetail(const google::protobuf::Any& detail, std::string* out) {
  std::string text;
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  if (google::protobuf::util::MessageToJsonString(detail, &text, options).ok()) {
    *out += text;
    return;
  }
  *out += R"({"@type":)";  // a type that is not linked in
  json::AppendString(detail.type_url(), out);
  *out += R"(,"value":")";
  json::AppendBase64(detail.value(), out);
  *out += "\"}";
}

/// The delay of google.rpc.RetryInfo in whole seconds; empty without one.
std::string RetryAfterOf(const google::rpc::Status& status) {
  google::rpc::RetryInfo retry;
  for (const google::protobuf::Any& detail : status.details()) {
    if (!detail.UnpackTo(&retry)) continue;
    const auto& delay = retry.retry_delay();
    return std::to_string(delay.seconds() + (delay.nanos() > 0 ? 1 : 0));
  }
  return {};
}

}  // namespace

std::string ErrorJson(const RpcStatus& status) {
  const google::rpc::Status proto = Parsed(status);
  std::string out = R"({"code":)" + std::to_string(proto.code()) + R"(,"message":)";
  json::AppendString(proto.message(), &out);
  out += R"(,"details":[)";
  for (int i = 0; i < proto.details_size(); ++i) {
    if (i > 0) out += ',';
    AppendDetail(proto.details(i), &out);
  }
  out += "]}";
  return out;
}

http::Response ErrorResponse(const RpcStatus& status, AnswerFormat format) {
  const bool as_protobuf = format == AnswerFormat::kProtobuf;
  http::Response response;
  response.status = HttpStatusOf(status.code, ReasonOf(status));
  response.headers.emplace_back("Content-Type", as_protobuf ? kProtobufType : kJsonType);
  constexpr int kUnauthenticated = 16;
  if (status.code == kUnauthenticated) response.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"dhpmap\"");
  if (std::string after_s = RetryAfterOf(Parsed(status)); !after_s.empty()) {
    response.headers.emplace_back("Retry-After", std::move(after_s));
  }
  response.body = as_protobuf ? Parsed(status).SerializeAsString() : ErrorJson(status) + "\n";
  return response;
}

http::Response ErrorResponse(const Status& status, AnswerFormat format) {
  return ErrorResponse(ToRpcStatus(status), format);
}

std::string ErrorLine(const RpcStatus& status) { return R"({"error":)" + ErrorJson(status) + "}\n"; }

}  // namespace dhpmap::gateway
