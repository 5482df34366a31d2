// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

constexpr char kMap[] = "hostile";
constexpr std::chrono::seconds kStay{5};  ///< how long each load stays once it stands
constexpr double kBudget_mib = 256, kBeside_mib = 200;

/// Runs `attack` in `count` threads at once.
void AtOnce(int count, const std::function<void()>& attack) {
  std::vector<std::jthread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back(attack);
}

void HangUpOnMeshes(const Target& target) {
  AtOnce(60, [&target] { BulkCalls(target).AbandonedMesh(); });
}

void AskForManyPoints(const Target& target) {
  AtOnce(8, [&target] { BulkCalls(target).ManyPoints(500'000); });
}

void LeaveBodiesUnfinished(const Target& target) {
  constexpr int kBodies = 15;
  constexpr std::size_t kBytes = 60 << 20;
  std::vector<std::unique_ptr<http::HttpClient>> clients;
  const std::string part(kBytes, ' ');
  for (int i = 0; i < kBodies; ++i) {
    auto& client = clients.emplace_back(std::make_unique<http::HttpClient>(target.http_port));
    std::ostringstream head;
    head << "POST /v1/maps/hostile:queryPoints HTTP/1.1\r\nHost: localhost\r\nContent-Length: " << kBytes + 1
         << "\r\n\r\n";
    client->SendRaw(head.str());
    client->SendRaw(part);
  }
  std::this_thread::sleep_for(kStay);
}

void LeaveAnswersUnread(const Target& target) {
  constexpr int kReaders = 40;
  std::vector<std::unique_ptr<http::HttpClient>> clients;
  for (int i = 0; i < kReaders; ++i) {
    auto& client = clients.emplace_back(std::make_unique<http::HttpClient>(target.http_port));
    client->SendRaw("GET /v1/maps/hostile:mesh HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  std::this_thread::sleep_for(kStay);
}

/// A process whose calls are left unread while it is stopped.
void LeaveCallsUnread(const ServerUnderTest& server, const Target& target, const char* kind, int num_calls) {
  const auto client =
      StartSelf(server.folder(), {"stalled-client", target.grpc_address, std::to_string(target.http_port),
                                  target.map_id, kind, std::to_string(num_calls)});
  std::this_thread::sleep_for(2 * kStay);
  client->Signal(SIGKILL);
}

}  // namespace

bool RunHostile(const HostileOptions& options) {
  ServerUnderTest server;
  if (!server.MapDataset(options.dataset, kMap)) return false;
  const Target target = server.TargetOf(kMap);
  const struct {
    const char* name;
    std::function<void()> run;
  } loads[] = {
      {"60 clients that hang up on a mesh", [&] { HangUpOnMeshes(target); }},
      {"8 queries of 500,000 points", [&] { AskForManyPoints(target); }},
      {"15 bodies of 60 MiB that do not end", [&] { LeaveBodiesUnfinished(target); }},
      {"40 meshes over REST that nobody reads", [&] { LeaveAnswersUnread(target); }},
      {"20 meshes over gRPC that nobody reads", [&] { LeaveCallsUnread(server, target, "meshes", 20); }},
      {"64 answers of 400,000 points that nobody reads", [&] { LeaveCallsUnread(server, target, "points", 64); }},
  };
  PeakWatch watch(server.pid());
  bool held = true;
  for (const auto& load : loads) {
    const double maps_mib = server.Metric("dhpmap_map_memory_bytes") / (1 << 20);
    watch.Reset();
    load.run();
    const ProcessUse peak = watch.peak();
    std::printf("%s: %d threads, %d descriptors\n", load.name, peak.num_threads, peak.num_files);
    held &= Expect("resident memory, with " + std::to_string(static_cast<int>(maps_mib)) + " MiB of maps",
                   peak.resident_mib, maps_mib + kBudget_mib + kBeside_mib, "MiB");
    std::this_thread::sleep_for(kStay);
    std::printf("        afterwards: %.0f MiB\n", UseOf(server.pid()).resident_mib);
  }
  held &= Expect("the server's exit code", server.process().Terminate().value_or(255), 0, "");
  return held;
}

}  // namespace dhpmap::rig
