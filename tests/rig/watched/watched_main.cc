// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-rig-watched: watches many maps on one server while they are edited on another, and says how long after the
// answer to an edit its watch reports it. The maps are there already: tests/rig/fleet/table.py makes them.
#include <grpcpp/grpcpp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "tests/rig/clients/lone_channel.h"
#include "tests/rig/watched/watched_maps.h"

namespace dhpmap::rig {
namespace {

using Clock = WatchedMaps::Clock;
constexpr double kPatience_s = 20;

struct Options {
  std::string owner, reader;
  int maps = 200, edits = 600;
  double rate_hz = 40;
};

/// An edit of a map that was answered.
struct Answered {
  std::size_t map = 0;
  std::int64_t revision = 0;
  Clock::time_point time;
};

/// Renames the map; the revision is -1 if that failed.
Answered Rename(v1::MapService::Stub& maps, const v1::Map& map, std::size_t number, int edit) {
  v1::UpdateMapRequest request;
  request.mutable_map()->set_name(map.name());
  request.mutable_map()->set_display_name("edit " + std::to_string(edit));
  request.mutable_update_mask()->add_paths("display_name");
  v1::UpdateMapResponse response;
  grpc::ClientContext context;
  const grpc::Status status = maps.UpdateMap(&context, request, &response);
  if (!status.ok()) std::printf("%s: %s\n", map.name().c_str(), status.error_message().c_str());
  return {number, status.ok() ? response.map().revision() : -1, Clock::now()};
}

void Print(const char* what, std::vector<double> values_ms) {
  std::sort(values_ms.begin(), values_ms.end());
  const auto last = static_cast<double>(values_ms.size() - 1);
  const auto at = [&](double share) { return values_ms[static_cast<std::size_t>(share * last)]; };
  std::printf("%s: p50 %.1f ms, p99 %.1f ms, most %.1f ms, of %zu\n", what, at(.5), at(.99), at(1), values_ms.size());
}

int Run(const Options& options) {
  const auto service = v1::MapService::NewStub(LoneChannel(options.owner));
  v1::ListMapsRequest request;
  request.set_page_size(options.maps);
  v1::ListMapsResponse listed;
  grpc::ClientContext context;
  const grpc::Status status = service->ListMaps(&context, request, &listed);
  if (!status.ok() || listed.maps().empty()) return std::printf("no maps: %s\n", status.error_message().c_str()), 1;
  const std::vector<v1::Map> maps(listed.maps().begin(), listed.maps().end());
  WatchedMaps watched(options.reader, maps);
  // The first edit of each map opens it and tells that its watch is there: not measured.
  std::vector<Answered> edits;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Answered edit = Rename(*service, maps[i], i, 0);
    if (edit.revision < 0 || !watched.WaitFor(i, edit.revision, kPatience_s)) return std::puts("a map has no watch"), 1;
  }
  std::vector<double> took_ms, behind_ms;
  auto due = Clock::now();
  for (int n = 1; n <= options.edits; ++n) {
    std::this_thread::sleep_until(due);
    due += std::chrono::microseconds(static_cast<std::int64_t>(1e6 / options.rate_hz));
    const std::size_t number = static_cast<std::size_t>(n) * 7 % maps.size();
    const auto begin = Clock::now();
    edits.push_back(Rename(*service, maps[number], number, n));
    if (edits.back().revision < 0) return 1;
    took_ms.push_back(std::chrono::duration<double, std::milli>(edits.back().time - begin).count());
  }
  for (const Answered& edit : edits) {
    if (!watched.WaitFor(edit.map, edit.revision, kPatience_s)) return std::puts("a watch lacks an edit"), 1;
    const auto behind = watched.TimeOf(edit.map, edit.revision) - edit.time;
    behind_ms.push_back(std::max(0.0, std::chrono::duration<double, std::milli>(behind).count()));
  }
  std::printf("%zu maps watched\n", maps.size());
  Print("an edit is answered after", took_ms);
  Print("its watch reports it after", behind_ms);
  return 0;
}

}  // namespace
}  // namespace dhpmap::rig

int main(int argc, char** argv) {
  dhpmap::rig::Options options;
  CLI::App app{"Watches many maps on one server while they are edited on another"};
  app.add_option("--owner", options.owner, "gRPC address of the server that edits")->required();
  app.add_option("--reader", options.reader, "gRPC address of the server that watches")->required();
  app.add_option("--maps", options.maps, "The first ones by name")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--edits", options.edits, "How many")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--rate", options.rate_hz, "Edits/s")->capture_default_str()->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  return dhpmap::rig::Run(options);
}
