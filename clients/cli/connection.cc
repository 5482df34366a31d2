// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/connection.h"

#include <google/protobuf/util/json_util.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <iostream>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "mapping/base/status.h"

namespace dhpmap {
namespace {

void PrintDetails(const grpc::Status& status) {
  google::rpc::Status details;
  if (status.error_details().empty() || !details.ParseFromString(status.error_details())) return;
  for (const auto& detail : details.details()) {
    google::rpc::BadRequest bad_request;
    google::rpc::ErrorInfo info;
    if (detail.UnpackTo(&bad_request)) {
      for (const auto& violation : bad_request.field_violations()) {
        std::cerr << "  " << violation.field() << ": " << violation.description() << "\n";
      }
    } else if (detail.UnpackTo(&info)) {
      std::cerr << "  reason: " << info.reason() << "\n";
    }
  }
}

}  // namespace

std::shared_ptr<grpc::Channel> Connect(const Session& session) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  return grpc::CreateCustomChannel(session.server, grpc::InsecureChannelCredentials(), arguments);
}

std::string MapName(const std::string& map) { return map.starts_with("maps/") ? map : "maps/" + map; }

std::string SubmapName(const std::string& map, std::int64_t id) {
  return MapName(map) + "/submaps/" + std::to_string(id);
}

ExitCode ReportError(const Session& session, const grpc::Status& status) {
  const auto code = static_cast<StatusCode>(status.error_code());
  std::cerr << "dhpmap: " << StatusCodeName(code) << ": " << status.error_message() << "\n";
  PrintDetails(status);
  if (code == StatusCode::kUnavailable) {
    std::cerr << "  Is dhpmap-server running at " << session.server << "? Say where with --server or DHPMAP_SERVER.\n";
  }
  return ExitCodeOf(status.error_code());
}

ExitCode ReportLocalError(const std::string& message, ExitCode code) {
  std::cerr << "dhpmap: " << message << "\n";
  return code;
}

void PrintJson(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;  // as the REST door prints them
  options.add_whitespace = true;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) {
    std::cerr << "dhpmap: the answer cannot be written as JSON: " << status.ToString() << "\n";
    return;
  }
  std::cout << text;
}

}  // namespace dhpmap
