// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/error_body.h"

#include <google/protobuf/util/json_util.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/app/status_table.h"
#include "server/rest/base64.h"
#include "server/rest/json_writer.h"
#include "server/rest/url.h"

namespace dhpmap::rest {
namespace {

google::rpc::Status ToProto(const RpcStatus& status) {
  google::rpc::Status proto;
  // Details that do not parse, or contradict the code, are dropped: the code and the message are what counts.
  if (!proto.ParseFromString(status.details) || proto.code() != status.code) proto.Clear();
  proto.set_code(status.code);
  proto.set_message(ToValidUtf8(status.message));
  return proto;
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
  AppendJsonString(detail.type_url(), out);
  *out += R"(,"value":")";
  AppendBase64(detail.value(), out);
  *out += "\"}";
}

}  // namespace

RpcStatus ToRpcStatus(const Status& status) {
  google::rpc::Status proto;
  proto.set_code(static_cast<int>(status.code()));
  proto.set_message(ToValidUtf8(status.message()));
  if (!status.reason().empty()) {
    google::rpc::ErrorInfo info;
    info.set_reason(status.reason());
    info.set_domain("dhpmap");
    proto.add_details()->PackFrom(info);
  }
  if (!status.violations().empty()) {
    google::rpc::BadRequest bad;
    for (const FieldViolation& violation : status.violations()) {
      auto* entry = bad.add_field_violations();
      entry->set_field(ToValidUtf8(violation.field));
      entry->set_description(ToValidUtf8(violation.description));
    }
    proto.add_details()->PackFrom(bad);
  }
  return {proto.code(), proto.message(), proto.SerializeAsString()};
}

std::string ErrorJson(const RpcStatus& status) {
  const google::rpc::Status proto = ToProto(status);
  std::string out = R"({"code":)" + std::to_string(proto.code()) + R"(,"message":)";
  AppendJsonString(proto.message(), &out);
  out += R"(,"details":[)";
  for (int i = 0; i < proto.details_size(); ++i) {
    if (i > 0) out += ',';
    AppendDetail(proto.details(i), &out);
  }
  out += "]}";
  return out;
}

HttpResponse ErrorResponse(const RpcStatus& status, AnswerFormat format, int http_status) {
  HttpResponse response;
  response.status = http_status != 0 ? http_status : HttpStatusOf(status.code);
  const bool as_protobuf = format == AnswerFormat::kProtobuf;
  response.headers.emplace_back("Content-Type", as_protobuf ? kProtobufType : kJsonType);
  response.body = as_protobuf ? ToProto(status).SerializeAsString() : ErrorJson(status) + "\n";
  return response;
}

HttpResponse ErrorResponse(const Status& status, AnswerFormat format, int http_status) {
  return ErrorResponse(ToRpcStatus(status), format, http_status);
}

std::string ErrorLine(const RpcStatus& status) { return R"({"error":)" + ErrorJson(status) + "}\n"; }

}  // namespace dhpmap::rest
