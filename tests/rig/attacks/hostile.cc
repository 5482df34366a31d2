// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/base/this_thread.h"
#include "tests/rig/at_once.h"
#include "tests/rig/attacks/floods.h"
#include "tests/rig/attacks/lying_frames.h"
#include "tests/rig/attacks/over_maps.h"
#include "tests/rig/attacks/quick_probes.h"
#include "tests/rig/attacks/unfinished_loads.h"
#include "tests/rig/attacks/unread_loads.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

constexpr char kHostileMap[] = "hostile";
constexpr std::chrono::seconds kStay{5};  ///< how long each load stays once it stands
constexpr int kNicenessOfLoads = 10;

void HangUpOnMeshes(const Target& target) {
  AtOnce(60, [&target](int) { BulkCalls(target).AbandonedMesh(); });
}

void AskForManyPoints(const Target& target) {
  AtOnce(8, [&target](int) { BulkCalls(target).ManyPoints(500'000); });
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
    client->SendRaw("GET /v1/maps/hostile/mesh HTTP/1.1\r\nHost: localhost\r\n\r\n");
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

/// Half of the watchers in another process, half over REST.
bool LeaveWatchesUnread(const ServerUnderTest& server, const Target& target, int num_watchers) {
  constexpr double kEdited_s = 8;
  const auto client =
      StartSelf(server.folder(), {"stalled-client", target.grpc_address, std::to_string(target.http_port),
                                  target.map_id, "watches", std::to_string(num_watchers / 2)});
  const bool held = EditWhileNobodyReads(target, num_watchers - num_watchers / 2, kEdited_s);
  client->Signal(SIGKILL);
  return held;
}

struct Load {
  const char* name;
  std::function<bool()> run;  ///< less than 15 s; whether what it was answered was well
};

std::vector<Load> LoadsOn(const ServerUnderTest& server, const Target& target) {
  // So that most of them need not say that they held.
  const auto unheard = [](auto load) { return [load = std::move(load)] { return load(), true; }; };
  return {
      {"60 clients that hang up on a mesh", unheard([&] { HangUpOnMeshes(target); })},
      {"8 queries of 500,000 points", unheard([&] { AskForManyPoints(target); })},
      {"15 bodies of 60 MiB that do not end", unheard([&] { LeaveBodiesUnfinished(target); })},
      {"40 meshes over REST that nobody reads", unheard([&] { LeaveAnswersUnread(target); })},
      {"20 meshes over gRPC that nobody reads", unheard([&] { LeaveCallsUnread(server, target, "meshes", 20); })},
      {"64 answers of 400,000 points that nobody reads",
       unheard([&] { LeaveCallsUnread(server, target, "points", 64); })},
      {"40 lines of NDJSON of 32 MiB that do not end", [&] { return LeaveLinesUnfinished(target); }},
      {"8 lines of NDJSON of 30 MB", [&] { return SendLargeLines(target); }},
      {"64 gRPC messages of 60 MiB that do not end", [&] { return LeaveMessagesUnfinished(target); }},
      {"8 streams of frames that lie", [&] { return SendLyingFrames(target); }},
      {"100 streams of large queries, each with a pin, that nobody reads",
       unheard([&] { LeaveCallsUnread(server, target, "query-streams", 100); })},
      {"200 watchers that do not read", [&] { return LeaveWatchesUnread(server, target, 200); }},
      {"flood: rapid resets", [&] { return ResetRapidly(target); }},
      {"flood: streams, SETTINGS never acknowledged", [&] { return LeaveSettingsUnacknowledged(target); }},
      {"flood: CONTINUATION without end", [&] { return ContinueHeadersForever(target); }},
      {"flood: a header value of 2^31 bytes", [&] { return DeclareHugeValue(target); }},
      {"flood: PING and SETTINGS", [&] { return PingForever(target); }},
      {"flood: 1,000 silent sockets", [&] { return ConnectSilently(target); }},
  };
}

/// In a thread of its own, for the load and all that it starts run at lower priority: the rig is to be slow, not the
/// server.
bool RunNicely(const Load& load) {
  bool held = false;
  std::jthread([&] {
    MakeThisThreadNicer(kNicenessOfLoads);
    held = load.run();
  }).join();
  return held;
}

/// What the table at the end says of a load.
struct Verdict {
  std::string name;
  OverMapsWatch::Look most;
  double worst_p99_ms = 0;
  bool held = false;
};

/// The load, and some time after it, with what the server takes meanwhile and how fast it answers what is quick.
Verdict RunWatched(const Load& load, ServerUnderTest& server, const std::shared_ptr<grpc::Channel>& quick,
                   PeakWatch& watch, OverMapsWatch& over_maps) {
  std::printf("%s\n", load.name);
  watch.Reset();
  over_maps.Reset();
  QuickProbes probes(quick, server.http_port(), kHostileMap);
  bool held = RunNicely(load);
  std::this_thread::sleep_for(kStay);
  const ProcessUse peak = watch.peak();
  const OverMapsWatch::Look most = over_maps.most();
  probes.Stop();
  std::printf("        %d threads, %d descriptors\n", peak.num_threads, peak.num_files);
  held &= ExpectBesideMaps(most);
  held &= ExpectBesideMaps({UseOf(server.pid()).resident_mib, server.MapsMib()});
  probes.Tell();
  held &= probes.Held();
  held &= Expect("quick calls that failed", probes.num_failures(), 0, "");
  return {.name = load.name, .most = most, .worst_p99_ms = probes.WorstP99_ms(), .held = held};
}

void PrintTable(const std::vector<Verdict>& verdicts) {
  std::printf("\n%-68s %9s %9s %9s %9s\n", "case", "RSS, MiB", "maps", "beside", "p99, ms");
  for (const Verdict& verdict : verdicts) {
    std::printf("%-68s %9.0f %9.0f %9.0f %9.1f  %s\n", verdict.name.c_str(), verdict.most.resident_mib,
                verdict.most.maps_mib, verdict.most.over_mib(), verdict.worst_p99_ms, verdict.held ? "held" : "FAILED");
  }
  std::fflush(stdout);
}

}  // namespace

bool RunHostile(const HostileOptions& options) {
  ServerUnderTest server;
  if (!server.MapDataset(options.dataset, kHostileMap)) return false;
  const Target target = server.TargetOf(kHostileMap);
  const auto quick = server.process().Connect();
  if (!quick->WaitForConnected(std::chrono::system_clock::now() + kStay)) return false;
  PeakWatch watch(server.pid());
  OverMapsWatch over_maps(server);
  bool held = true;
  std::vector<Verdict> verdicts;
  for (const Load& load : LoadsOn(server, target)) {
    if (std::string_view(load.name).find(options.only) == std::string_view::npos) continue;
    verdicts.push_back(RunWatched(load, server, quick, watch, over_maps));
    held &= verdicts.back().held;
  }
  held &= Expect("the server's exit code", server.process().Terminate().value_or(255), 0, "");
  PrintTable(verdicts);
  if (verdicts.empty()) std::printf("FAILED: the name of no case contains '%s'\n", options.only.c_str());
  return held && !verdicts.empty();
}

}  // namespace dhpmap::rig
