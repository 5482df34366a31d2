// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <cstdint>
#include <memory>
#include <string>

#include "clients/cli/exit_code.h"
#include "clients/cpp/calls/caller.h"
#include "clients/cpp/calls/pages.h"

namespace CLI {
class App;
}

namespace dhpmap {

/// State that all commands share: the server's address, the output format and the exit code. Set by the command line.
struct Session {
  std::string server = "127.0.0.1:50051";
  std::string token_file;  ///< file with the key for every call; empty: none
  std::string ca;  ///< PEM file of the CAs that sign server certificates; "system": those of this system; empty: no TLS
  bool json = false;
  ExitCode exit_code = ExitCode::kOk;
  std::shared_ptr<client::Caller> caller;  ///< after Open
};

/// Creates session.caller, without contacting the server. InvalidArgument with a violation of "token", "token_file" or
/// "ca_file".
client::Status Open(Session& session);

/// "kitchen" and "maps/kitchen" -> "maps/kitchen".
std::string MapName(const std::string& map);
std::string SubmapName(const std::string& map, std::int64_t id);

/// Prints "dhpmap: NOT_FOUND: message" with details and hints to stderr; returns the exit code.
ExitCode ReportError(const Session& session, const client::Status& status);
/// The same for a local error.
ExitCode ReportLocalError(const std::string& message, ExitCode code = ExitCode::kLocalFile);

/// Prints the message to stdout as JSON, in the form of the REST door.
void PrintJson(const google::protobuf::Message& message);
/// The same on one line, for streams.
void PrintJsonLine(const google::protobuf::Message& message);

/// Calls the server, such as Ask(session, &v1::MapService::Stub::GetMap, request). No retries: a user at a terminal
/// should see at once that the server is unreachable.
template <typename Stub, typename Request, typename Response>
client::Result<Response> Ask(const Session& session,
                             grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                             const Request& request) {
  return session.caller->Call(method, request, 0, client::Again::kNo);
}
/// Reads all pages of a list into one response.
template <typename Stub, typename Request, typename Response>
client::Result<Response> AskForAll(const Session& session,
                                   grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                                   const Request& request) {
  return client::ReadAllPages(*session.caller, method, request, client::Again::kNo);
}
/// Prints an answer, as JSON or by `print(answer)`, or its error.
template <typename Response, typename Print>
ExitCode Tell(const Session& session, const client::Result<Response>& answer, Print print) {
  if (!answer.ok()) return ReportError(session, answer.status());
  if (session.json) PrintJson(*answer);
  else print(*answer);
  return ExitCode::kOk;
}

// Each function adds its subcommands; a chosen one runs and sets session.exit_code.
void AddMapCommand(CLI::App& app, Session& session);
void AddMapsCommands(CLI::App& app, Session& session);
void AddSubmapsCommand(CLI::App& app, Session& session);
void AddQueryCommands(CLI::App& app, Session& session);
void AddEditCommands(CLI::App& app, Session& session);
void AddLogCommand(CLI::App& app, Session& session);
void AddUndoCommands(CLI::App& app, Session& session);
void AddBackupCommand(CLI::App& app, Session& session);
void AddVerifyCommand(CLI::App& app, Session& session);
void AddExportCommands(CLI::App& app, Session& session);
void AddWatchCommand(CLI::App& app, Session& session);
void AddSessionsCommands(CLI::App& app, Session& session);
/// `keys` and `whoami`.
void AddKeysCommands(CLI::App& app, Session& session);
void AddAuditCommand(CLI::App& app, Session& session);
void AddFleetCommands(CLI::App& app, Session& session);
void AddDoctorCommand(CLI::App& app, Session& session);
void AddUiCommand(CLI::App& app, Session& session);
void AddReplayCommand(CLI::App& app, Session& session);
void AddRestoreCommand(CLI::App& app, Session& session);
/// The completion script is made from `app` when it is requested.
void AddCompletionCommand(CLI::App& app, Session& session);
// The same for subcommands of `maps`.
void AddMapFileCommands(CLI::App& maps, Session& session);
// The same for subcommands of `export`.
void AddOctomapCommand(CLI::App& parent, Session& session);
// The same for subcommands of `query`.
void AddGridCommand(CLI::App& query, Session& session);
void AddObjectCommands(CLI::App& query, Session& session);
void AddSliceCommand(CLI::App& query, Session& session);

}  // namespace dhpmap
