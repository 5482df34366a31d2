// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/connection.h"

#include <google/protobuf/util/json_util.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <fstream>
#include <iostream>
#include <iterator>

#include "clients/cli/printable.h"
#include "clients/cli/token.h"
#include "proto/types/status_conversion.h"

namespace dhpmap {
namespace {

void PrintDetails(const grpc::Status& status) {
  const ErrorDetails details = ReadErrorDetails(status.error_details());
  if (!details.reason.empty()) std::cerr << "  reason: " << details.reason << "\n";
  for (const FieldViolation& violation : details.violations) {
    const std::string& message = status.error_message();  // which says the first
    if (message.find(violation.field + ": " + violation.description) != std::string::npos) continue;
    std::cerr << "  " << Printable(violation.field) << ": " << Printable(violation.description) << "\n";
  }
}

void PrintMessage(const google::protobuf::Message& message, bool in_lines) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;  // as the REST door prints them
  options.add_whitespace = in_lines;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) {
    std::cerr << "dhpmap: the answer cannot be written as JSON: " << status.ToString() << "\n";
    return;
  }
  std::cout << text;
}

/// Of Session::ca.
std::shared_ptr<grpc::ChannelCredentials> CredentialsOf(const std::string& ca) {
  if (ca.empty()) return grpc::InsecureChannelCredentials();
  grpc::SslCredentialsOptions options;
  if (ca != "system") {
    std::ifstream in(ca, std::ios::binary);
    options.pem_root_certs.assign(std::istreambuf_iterator<char>(in), {});
    if (options.pem_root_certs.empty()) {
      ReportLocalError("--ca: cannot read " + ca + ", so that no server is trusted");
      options.pem_root_certs = "none";  // not empty: that would mean those of the system
    }
  }
  return grpc::SslCredentials(options);
}

}  // namespace

std::shared_ptr<grpc::Channel> Connect(const Session& session) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  // A server that is dead or cut off is noticed, and one that comes back is found soon.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2'000);
  const auto credentials = CredentialsOf(session.ca);
  if (session.token.empty()) return grpc::CreateCustomChannel(session.server, credentials, arguments);
  return grpc::experimental::CreateCustomChannelWithInterceptors(session.server, credentials, arguments,
                                                                 ShowingToken(session.token));
}

std::string MapName(const std::string& map) { return map.starts_with("maps/") ? map : "maps/" + map; }

std::string SubmapName(const std::string& map, std::int64_t id) {
  return MapName(map) + "/submaps/" + std::to_string(id);
}

ExitCode ReportError(const Session& session, const grpc::Status& status) {
  const auto code = static_cast<StatusCode>(status.error_code());
  std::cerr << "dhpmap: " << StatusCodeName(code) << ": " << Printable(status.error_message()) << "\n";
  PrintDetails(status);
  if (code == StatusCode::kUnauthenticated && session.token.empty()) {
    std::cerr << "  Say where your key is with --token-file; `dhpmap keys create` makes one.\n";
  }
  if (code == StatusCode::kUnavailable) {
    std::cerr << "  Is dhpmap-server running at " << session.server << "? Say where with --server or DHPMAP_SERVER";
    std::cerr << (session.ca.empty() ? "; a server with TLS wants --ca.\n" : ", and whom to trust with --ca.\n");
  }
  return ExitCodeOf(status.error_code());
}

ExitCode ReportLocalError(const std::string& message, ExitCode code) {
  std::cerr << "dhpmap: " << message << "\n";
  return code;
}

void PrintJson(const google::protobuf::Message& message) { PrintMessage(message, true); }

void PrintJsonLine(const google::protobuf::Message& message) {
  PrintMessage(message, false);
  std::cout << "\n";
}

}  // namespace dhpmap
