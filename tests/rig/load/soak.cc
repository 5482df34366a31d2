// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/rig/clients/frame_feed.h"
#include "tests/rig/clients/planner_calls.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr char kSoaked[] = "soak";
constexpr int kLooks = 10;  // at what the server takes, evenly over the time

/// What a server took of the machine in a tenth of the time.
struct Look {
  ProcessUse peak;
  double maps_mib = 0;
};

/// Prints a line a tenth of the time.
std::vector<Look> Watch(ServerUnderTest& server, double seconds) {
  std::vector<Look> looks;
  PeakWatch peak(server.pid());
  for (int i = 0; i < kLooks; ++i) {
    peak.Reset();
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds / kLooks));
    looks.push_back({.peak = peak.peak(), .maps_mib = server.MapsMib()});
    const Look& look = looks.back();
    std::printf("after %5.0f s: maps %4.0f MiB, resident %4.0f MiB at most, %d threads, %d files\n",
                seconds * (i + 1) / kLooks, look.maps_mib, look.peak.resident_mib, look.peak.num_threads,
                look.peak.num_files);
    std::fflush(stdout);
  }
  return looks;
}

/// The most that `of` says of the looks from `first` to before `end`.
template <typename Of>
double Most(const std::vector<Look>& looks, int first, int end, Of&& of) {
  double most = 0;
  for (int i = first; i < end; ++i) most = std::max(most, static_cast<double>(of(looks[static_cast<std::size_t>(i)])));
  return most;
}

/// The last third against the third before it; the first is for what every server has to make once.
bool IsFlat(const std::vector<Look>& looks) {
  constexpr double kNoise_mib = 50;
  const auto beside_maps = [](const Look& look) { return look.peak.resident_mib - look.maps_mib; };
  const auto threads = [](const Look& look) { return look.peak.num_threads; };
  const auto files = [](const Look& look) { return look.peak.num_files; };
  bool held = Expect("resident memory beside the maps, in the last third", Most(looks, 7, kLooks, beside_maps),
                     Most(looks, 3, 7, beside_maps) + kNoise_mib, "MiB");
  held &= Expect("threads", Most(looks, 7, kLooks, threads), Most(looks, 3, 7, threads), "");
  held &= Expect("files", Most(looks, 7, kLooks, files), Most(looks, 3, 7, files), "");
  return held;
}

bool Report(const PlannerCalls::Table& table, const Latencies& ack_gaps,
            const std::vector<std::unique_ptr<PlannerCalls>>& clients) {
  int num_failures = ack_gaps.num_failures();
  for (std::size_t kind = 0; kind < table.size(); ++kind) {
    std::printf("%-25s %s\n", PlannerCalls::kKinds[kind], table[kind].Summary().c_str());
    num_failures += table[kind].num_failures();
  }
  std::printf("%-25s %s\n", "gaps of acknowledgements", ack_gaps.Summary().c_str());
  for (const auto& client : clients) {
    for (const std::string& complaint : client->complaints()) std::printf("FAILED: %s\n", complaint.c_str());
  }
  return Expect("calls and frames that failed", num_failures, 0, "");
}

}  // namespace

bool RunSoak(const SoakOptions& options) {
  const auto frames = ReadFrames(options.dataset);
  if (!frames.ok()) return std::printf("FAILED: %s\n", frames.status().ToString().c_str()), false;
  ServerUnderTest server;
  if (!server.MapDataset(options.dataset, kSoaked)) return false;
  const auto mapping = v1::MappingService::NewStub(server.process().Connect());
  PlannerCalls::Table table;
  Latencies ack_gaps;
  grpc::Status fed;
  std::vector<Look> looks;
  std::vector<std::unique_ptr<PlannerCalls>> clients;
  {
    std::vector<std::jthread> threads;
    threads.emplace_back([&](const std::stop_token& stop) {
      fed = FeedUntil(*mapping, kSoaked, *frames, options.frame_rate_hz, stop, ack_gaps);
    });
    for (int i = 0; i < options.num_clients; ++i) {
      PlannerCalls& calls =
          *clients.emplace_back(std::make_unique<PlannerCalls>(server.TargetOf(kSoaked), static_cast<unsigned>(i)));
      threads.emplace_back([&](const std::stop_token& stop) { calls.Run(options.rate_hz, table, stop); });
    }
    looks = Watch(server, options.seconds);
    for (std::jthread& thread : threads) thread.request_stop();
  }
  bool held = Report(table, ack_gaps, clients);
  if (!fed.ok()) std::printf("FAILED: the stream of frames ended: %s\n", fed.error_message().c_str()), held = false;
  held &= IsFlat(looks);
  return held;
}

}  // namespace dhpmap::rig
