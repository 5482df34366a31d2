// SPDX-License-Identifier: BSD-3-Clause
// dhpmap maps export|import: one map as a file.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/file_download.h"
#include "clients/cli/progress_bar.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap {
namespace {

constexpr std::size_t kPartBytes = 256u << 10;

struct ExportFile {
  std::string map, path;
  bool replaces = false;
};

ExitCode RunExport(const Session& session, const ExportFile& options) {
  if (!options.replaces && options.path != "-" && std::filesystem::exists(options.path)) {
    return ReportLocalError(options.path + " is there already: --force replaces it", ExitCode::kUsage);
  }
  auto file = OutputFile::Open(options.path);
  if (!file.ok()) return ReportLocalError(file.status().message());
  v1::ExportMapRequest request;
  request.set_name(MapName(options.map));
  const auto parts = session.caller->Read(&v1::MapService::Stub::ExportMap, request);
  const ExitCode code = Download(session, *parts, "map", *file, [](const v1::ExportMapResponse&) {});
  if (code != ExitCode::kOk || options.path == "-") return code;
  if (session.json) std::cout << "{\n  \"bytes\": " << file->num_bytes() << "\n}\n";
  else std::cout << options.path << ": " << Bytes(static_cast<double>(file->num_bytes())) << ", as committed\n";
  return ExitCode::kOk;
}

struct ImportFile {
  std::string path, map;
};

/// Sends the file until the server stops accepting data.
void SendFile(std::ifstream& file, std::int64_t num_bytes, const std::string& map_id,
              grpc::ClientWriterInterface<v1::ImportMapRequest>& stream) {
  ProgressBar progress(static_cast<std::size_t>(num_bytes), "bytes");
  v1::ImportMapRequest part;
  part.set_map_id(map_id);
  part.set_total_bytes(num_bytes);
  std::int64_t num_sent = 0;
  // The first message has no data, so that a name conflict costs nothing.
  for (bool has_more = stream.Write(part); has_more && num_sent < num_bytes;) {
    part.Clear();
    std::string& data = *part.mutable_data();
    data.resize(kPartBytes);
    file.read(data.data(), static_cast<std::streamsize>(data.size()));
    data.resize(static_cast<std::size_t>(file.gcount()));
    if (data.empty()) break;  // the file was truncated: the server detects that
    num_sent += static_cast<std::int64_t>(data.size());
    has_more = stream.Write(part);
    progress.Show(static_cast<std::size_t>(num_sent), MegabytesASecond(num_sent, progress.elapsed_s()));
  }
  stream.WritesDone();
  if (num_sent == num_bytes) progress.Print("all of it is sent: the server looks through it");
}

ExitCode RunImport(const Session& session, const ImportFile& options) {
  std::error_code error;
  const auto num_bytes = static_cast<std::int64_t>(std::filesystem::file_size(options.path, error));
  std::ifstream file(options.path, std::ios::binary);
  if (error || !file) return ReportLocalError("cannot read " + options.path);
  if (num_bytes == 0) return ReportLocalError(options.path + " is empty");
  grpc::ClientContext context;
  v1::ImportMapResponse response;
  session.caller->Introduce(context);
  const auto stream = session.caller->stub<v1::MapService::Stub>().ImportMap(&context, &response);
  const std::string map_id = options.map.starts_with("maps/") ? options.map.substr(5) : options.map;
  SendFile(file, num_bytes, map_id, *stream);
  const client::Status status = session.caller->StatusOf(stream->Finish());
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else
    std::cout << response.map().name() << " holds " << response.map().num_submaps() << " submaps at revision "
              << response.revision() << "\n";
  return ExitCode::kOk;
}

}  // namespace

void AddMapFileCommands(CLI::App& maps, Session& session) {
  auto out = std::make_shared<ExportFile>();
  CLI::App* exporting = maps.add_subcommand("export", "Write one map to a file, as committed, while mapping continues");
  exporting->add_option("map", out->map, "Name of the map")->required();
  exporting->add_option("file", out->path, "File to write, - for stdout")->required();
  exporting->add_flag("--force", out->replaces, "Overwrite an existing file");
  exporting->callback([out, &session] { session.exit_code = RunExport(session, *out); });
  auto in = std::make_shared<ImportFile>();
  CLI::App* importing = maps.add_subcommand("import", "Import a map exported by this version or an older one");
  importing->add_option("file", in->path, "File to read")->required();
  importing->add_option("--map", in->map, "Name of the new map; default: its name in the file");
  importing->callback([in, &session] { session.exit_code = RunImport(session, *in); });
}

}  // namespace dhpmap
