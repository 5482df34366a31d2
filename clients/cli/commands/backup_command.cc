// SPDX-License-Identifier: BSD-3-Clause
// dhpmap backup: a copy of the server's database.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/file_download.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap {
namespace {

ExitCode RunBackup(const Session& session, const std::string& path, bool replaces) {
  if (!replaces && path != "-" && std::filesystem::exists(path)) {
    return ReportLocalError(path + " is there already: --force replaces it", ExitCode::kUsage);
  }
  auto file = OutputFile::Open(path);
  if (!file.ok()) return ReportLocalError(file.status().message());
  const auto parts = session.caller->Read(&v1::MapService::Stub::BackupMaps, v1::BackupMapsRequest());
  const ExitCode code = Download(session, *parts, "backup", *file, [](const v1::BackupMapsResponse&) {});
  if (code != ExitCode::kOk || path == "-") return code;
  if (session.json) std::cout << "{\n  \"bytes\": " << file->num_bytes() << "\n}\n";
  else std::cout << path << ": " << Bytes(static_cast<double>(file->num_bytes())) << ", all maps as committed\n";
  return ExitCode::kOk;
}

}  // namespace

void AddBackupCommand(CLI::App& app, Session& session) {
  struct Options {
    std::string path;
    bool replaces = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("backup", "Copy the server's database with all maps, while it keeps running");
  command->add_option("file", options->path, "File to write, - for stdout")->required();
  command->add_flag("--force", options->replaces, "Overwrite an existing file");
  command->callback([options, &session] { session.exit_code = RunBackup(session, options->path, options->replaces); });
}

}  // namespace dhpmap
