// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/connection.h"

#include <google/protobuf/util/json_util.h>

#include <iostream>

#include "clients/cli/printable.h"

namespace dhpmap {
namespace {

/// Timeout of calls without their own: finishing or restoring a large map may take long.
constexpr double kLongestCall_s = 86'400;

void PrintDetails(const client::Status& status) {
  if (!status.reason.empty()) std::cerr << "  reason: " << status.reason << "\n";
  for (const client::FieldViolation& violation : status.violations) {
    const std::string& message = status.message;  // contains the first violation
    if (message.find(violation.field + ": " + violation.description) != std::string::npos) continue;
    std::cerr << "  " << Printable(violation.field) << ": " << Printable(violation.description) << "\n";
  }
}

void PrintMessage(const google::protobuf::Message& message, bool in_lines) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;  // as in the REST door
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

}  // namespace

client::Status Open(Session& session) {
  const bool by_system = session.ca == "system";
  auto caller = client::Caller::Open(session.server, {.deadline_s = kLongestCall_s,
                                                      .tls = by_system,
                                                      .ca_file = by_system ? "" : session.ca,
                                                      .token_file = session.token_file});
  if (!caller.ok()) return caller.status();
  session.caller = *std::move(caller);
  return {};
}

std::string MapName(const std::string& map) { return map.starts_with("maps/") ? map : "maps/" + map; }

std::string SubmapName(const std::string& map, std::int64_t id) {
  return MapName(map) + "/submaps/" + std::to_string(id);
}

ExitCode ReportError(const Session& session, const client::Status& status) {
  std::cerr << "dhpmap: " << client::StatusCodeName(status.code) << ": " << Printable(status.message) << "\n";
  PrintDetails(status);
  if (status.code == client::StatusCode::kUnauthenticated && session.token_file.empty()) {
    std::cerr << "  Say where your key is with --token-file; `dhpmap keys create` makes one.\n";
  }
  if (status.code == client::StatusCode::kUnavailable) {
    std::cerr << "  Is dhpmap-server running at " << session.server << "? Say where with --server or DHPMAP_SERVER";
    std::cerr << (session.ca.empty() ? "; a server with TLS wants --ca.\n" : ", and whom to trust with --ca.\n");
  }
  return ExitCodeOf(status.code);
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
