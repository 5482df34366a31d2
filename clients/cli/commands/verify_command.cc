// SPDX-License-Identifier: BSD-3-Clause
// dhpmap verify: checks the stored data of a map.
#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap {
namespace {

void PrintReport(const std::string& map, const v1::VerifyMapResponse& report) {
  std::cout << map << " at revision " << report.revision() << ": " << report.num_submaps() << " submaps, "
            << report.num_tiles() << " layers of tiles, " << report.num_blocks() << " of blocks, "
            << Bytes(static_cast<double>(report.blob_bytes())) << "\n";
  if (report.num_shared_voxels() > 0) {
    std::cout << report.num_shared_voxels() << " voxels are held by several settled objects: not refined since\n";
  }
  for (const v1::VerifyMapResponse::SharedBlock& place : report.shared_blocks()) {
    std::cout << "  " << place.num_voxels() << " of block (" << place.block_x() << ", " << place.block_y() << ", "
              << place.block_z() << ") by " << place.first_instance_id() << " and " << place.second_instance_id()
              << "\n";
  }
  for (const v1::VerifyMapResponse::Fault& fault : report.faults()) {
    std::cout << v1::VerifyMapResponse::Fault::Kind_Name(fault.kind()) << "  " << fault.location() << " "
              << fault.description() << "\n";
  }
  if (report.num_faults() > report.faults_size()) {
    std::cout << "and " << report.num_faults() - report.faults_size() << " more\n";
  }
  if (report.num_faults() == 0) std::cout << "all of it is whole\n";
  if (report.repaired()) std::cout << "what could not be read was dropped, the rest is kept\n";
}

ExitCode RunVerify(const Session& session, const std::string& map, bool repairs) {
  v1::VerifyMapRequest request;
  request.set_name(MapName(map));
  request.set_repair(repairs);
  const auto report = Ask(session, &v1::MapService::Stub::VerifyMap, request);
  if (!report.ok()) return ReportError(session, report.status());
  if (session.json) PrintJson(*report);
  else PrintReport(MapName(map), *report);
  return report->num_faults() == 0 || report->repaired() ? ExitCode::kOk : ExitCode::kServerFailed;
}

}  // namespace

void AddVerifyCommand(CLI::App& app, Session& session) {
  struct Options {
    std::string map;
    bool repairs = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("verify", "Verify all stored data of a map; exit code 6 for faults");
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_flag("--repair", options->repairs,
                    "Drop unreadable data and keep the rest; needs a closed map, as damaged ones are");
  command->callback([options, &session] { session.exit_code = RunVerify(session, options->map, options->repairs); });
}

}  // namespace dhpmap
