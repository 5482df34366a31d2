// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <memory>
#include <string>

#include "clients/cli/exit_code.h"

namespace CLI {
class App;
}

namespace dhpmap {

/// What every command needs: where the server is, how to answer, and how it went. Filled by the command line.
struct Session {
  std::string server = "127.0.0.1:50051";
  std::string token;  ///< shown to the server with every call; empty: none
  std::string ca;  ///< PEM file of who has signed the server's certificate, "system" for this system's; empty: no TLS
  bool json = false;
  ExitCode exit_code = ExitCode::kOk;
};

/// A channel without a limit on what it receives. Connects on the first call. Over TLS where session.ca says so; a file
/// that cannot be read is told as such, and nothing is trusted.
std::shared_ptr<grpc::Channel> Connect(const Session& session);

/// "kitchen" and "maps/kitchen" -> "maps/kitchen".
std::string MapName(const std::string& map);
std::string SubmapName(const std::string& map, std::int64_t id);

/// Prints "dhpmap: NOT_FOUND: message" with details and hints to stderr; returns the exit code.
ExitCode ReportError(const Session& session, const grpc::Status& status);
/// The same for something that went wrong here.
ExitCode ReportLocalError(const std::string& message, ExitCode code = ExitCode::kLocalFile);

/// The message as JSON, in the way of the REST door, to stdout.
void PrintJson(const google::protobuf::Message& message);
/// The same on one line, for streams.
void PrintJsonLine(const google::protobuf::Message& message);

// Each adds its subcommands; when one is chosen it runs and sets session.exit_code.
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
void AddUiCommand(CLI::App& app, Session& session);
void AddReplayCommand(CLI::App& app, Session& session);
void AddRestoreCommand(CLI::App& app, Session& session);
/// The script is made of `app` as it is when it is asked for.
void AddCompletionCommand(CLI::App& app, Session& session);
// Likewise, subcommands of `maps`.
void AddMapFileCommands(CLI::App& maps, Session& session);
// Likewise, subcommands of `export`.
void AddOctomapCommand(CLI::App& parent, Session& session);
// Likewise, subcommands of `query`.
void AddGridCommand(CLI::App& query, Session& session);
void AddObjectCommands(CLI::App& query, Session& session);
void AddSliceCommand(CLI::App& query, Session& session);

}  // namespace dhpmap
