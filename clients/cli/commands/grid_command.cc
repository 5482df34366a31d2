// SPDX-License-Identifier: BSD-3-Clause
// dhpmap query grid: distances at the nodes of a grid as a NumPy file.
#include <CLI/CLI.hpp>
#include <bit>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/output_file.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/query_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct GridCommand {
  std::string map, file;
  std::vector<double> box_m;
  double resolution_m = 0.05;
  QueryFlags query;
  double padding_m = 0;
};

/// Header of a .npy file, version 1.0: little-endian floats, z is the slowest index. Its length is a multiple of 64.
std::string NumpyHead(int num_z, int num_y, int num_x) {
  static_assert(std::endian::native == std::endian::little);
  std::string text = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(num_z) + ", " +
                     std::to_string(num_y) + ", " + std::to_string(num_x) + "), }";
  constexpr std::size_t kBefore = 10, kMultiple = 64;
  while ((kBefore + text.size() + 1) % kMultiple != 0) text += ' ';
  text += '\n';
  std::string head = "\x93NUMPY";
  head += {'\x01', '\x00', static_cast<char>(text.size() & 0xFF), static_cast<char>(text.size() >> 8)};
  return head + text;
}

ExitCode RunGrid(const Session& session, const GridCommand& command) {
  v1::QueryDistanceGridRequest request;
  request.set_map(MapName(command.map));
  v1::Vector3 &low = *request.mutable_box()->mutable_min_m(), &high = *request.mutable_box()->mutable_max_m();
  low.set_x(command.box_m[0]);
  low.set_y(command.box_m[1]);
  low.set_z(command.box_m[2]);
  high.set_x(command.box_m[3]);
  high.set_y(command.box_m[4]);
  high.set_z(command.box_m[5]);
  request.set_resolution_m(command.resolution_m);
  *request.mutable_options() = ToProto(command.query, command.map);
  SetRead(command.query.world.asker.read, request);
  if (command.padding_m != 0) request.mutable_options()->mutable_padding()->set_default_padding_m(command.padding_m);
  auto file = OutputFile::Open(command.file);
  if (!file.ok()) return ReportLocalError(file.status().message());
  const auto parts = session.caller->Read(&v1::QueryService::Stub::QueryDistanceGrid, request);
  v1::QueryDistanceGridResponse part, first;
  while (parts->Next(part)) {
    if (part.first_node() == 0) {
      first = part;
      file->Write(NumpyHead(part.num_z(), part.num_y(), part.num_x()));
    }
    file->Write({reinterpret_cast<const char*>(part.distance_m().data()),
                 sizeof(float) * static_cast<std::size_t>(part.distance_m_size())});
  }
  if (const client::Status status = parts->Finish(); !status.ok()) return ReportError(session, status);
  if (const Status closed = file->Close(); !closed.ok()) return ReportLocalError(closed.message());
  if (command.file != "-") {
    std::cout << command.file << ": " << first.num_x() << " x " << first.num_y() << " x " << first.num_z()
              << " distances in m every " << Fixed(command.resolution_m, 3) << " m, of revision " << first.revision()
              << "\n";
  }
  return ExitCode::kOk;
}

}  // namespace

void AddGridCommand(CLI::App& query, Session& session) {
  auto command = std::make_shared<GridCommand>();
  CLI::App* grid = query.add_subcommand("grid", "Distances at the nodes of a grid, as a NumPy array [z, y, x]");
  grid->add_option("map", command->map, "Name of the map")->required();
  grid->add_option("--box", command->box_m, "MIN_X MIN_Y MIN_Z MAX_X MAX_Y MAX_Z in m")->expected(6)->required();
  grid->add_option("--resolution", command->resolution_m, "Spacing of the nodes, in m")->capture_default_str();
  AddQueryFlags(*grid, command->query);
  AddPaddingFlag(*grid, command->padding_m);
  grid->add_option("--out", command->file, "FILE.npy, - for stdout")->required();
  grid->callback([command, &session] { session.exit_code = RunGrid(session, *command); });
}

}  // namespace dhpmap
