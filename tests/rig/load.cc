// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <thread>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/rig/frame_feed.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

constexpr char kMap[] = "load";
constexpr std::chrono::milliseconds kBetweenProbes{20};
constexpr int kNicenessOfClients = 10;
constexpr double kMostProbe_ms = 20, kMostAckGap_ms = 250;

double SecondsSince(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Calls `probe` every 20 ms until stopped.
std::jthread Probe(Latencies& latencies, std::function<bool()> probe) {
  return std::jthread([&latencies, probe = std::move(probe)](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto begin = std::chrono::steady_clock::now();
      if (probe()) latencies.Add(SecondsSince(begin));
      else latencies.AddFailure();
      std::this_thread::sleep_until(begin + kBetweenProbes);
    }
  });
}

std::function<bool()> AskForSubmap(const std::shared_ptr<grpc::Channel>& channel) {
  const std::shared_ptr<v1::SubmapService::Stub> stub = v1::SubmapService::NewStub(channel);
  return [stub] {
    grpc::ClientContext context;
    v1::GetSubmapRequest request;
    request.set_name(std::string("maps/") + kMap + "/submaps/1");
    v1::GetSubmapResponse response;
    return stub->GetSubmap(&context, request, &response).ok();
  };
}

std::function<bool()> AskForHealth(int http_port) {
  const auto client = std::make_shared<http::HttpClient>(http_port);
  return [client] { return client->Ask("GET", "/healthz").status == 200; };
}

/// What the clients of a load saw.
struct Seen {
  Latencies get_submap, health, ack_gaps;
};

bool Report(const Seen& seen, double seconds) {
  std::printf("GetSubmap: %s\n/healthz: %s\ngaps between acknowledgements in %.0f s: %s\n",
              seen.get_submap.Summary().c_str(), seen.health.Summary().c_str(), seconds,
              seen.ack_gaps.Summary().c_str());
  bool held = Expect("GetSubmap p99", 1e3 * seen.get_submap.Percentile_s(0.99), kMostProbe_ms, "ms");
  held &= Expect("/healthz p99", 1e3 * seen.health.Percentile_s(0.99), kMostProbe_ms, "ms");
  held &= Expect("ack gap p99.9", 1e3 * seen.ack_gaps.Percentile_s(0.999), kMostAckGap_ms, "ms");
  const int failures = seen.get_submap.num_failures() + seen.health.num_failures() + seen.ack_gaps.num_failures();
  held &= Expect("calls or frames that failed", failures, 0, "");
  return held;
}

}  // namespace

bool RunLoad(const LoadOptions& options) {
  const auto frames = ReadFrames(options.dataset);
  if (!frames.ok()) return std::printf("FAILED: %s\n", frames.status().ToString().c_str()), false;
  ServerUnderTest server;
  if (!server.MapDataset(options.dataset, kMap)) return false;
  const Target target = server.TargetOf(kMap);
  const auto mapping = v1::MappingService::NewStub(server.process().Connect());
  PeakWatch peak(server.pid());
  Seen seen;
  grpc::Status fed;
  {
    std::jthread feeder(
        [&](const std::stop_token& stop) { fed = FeedUntil(*mapping, kMap, *frames, 0, stop, seen.ack_gaps); });
    const auto bulk = StartSelf(server.folder(),
                                {"bulk-clients", target.grpc_address, std::to_string(target.http_port), kMap,
                                 std::to_string(options.num_bulk_clients)},
                                kNicenessOfClients);
    const std::jthread submaps = Probe(seen.get_submap, AskForSubmap(server.process().Connect()));
    const std::jthread health = Probe(seen.health, AskForHealth(target.http_port));
    std::this_thread::sleep_for(std::chrono::duration<double>(options.seconds));
    bulk->Signal(SIGTERM);
    (void)bulk->Wait(60);
    std::printf("%s", bulk->Stdout().c_str());
  }
  bool held = Report(seen, options.seconds);
  if (!fed.ok()) std::printf("FAILED: the stream of frames ended: %s\n", fed.error_message().c_str()), held = false;
  constexpr double kBudget_mib = 256, kBeside_mib = 200;
  const double maps_mib = server.Metric("dhpmap_map_memory_bytes") / (1 << 20);
  held &= Expect("resident memory, with " + std::to_string(static_cast<int>(maps_mib)) + " MiB of maps",
                 peak.peak().resident_mib, maps_mib + kBudget_mib + kBeside_mib, "MiB");
  return held;
}

}  // namespace dhpmap::rig
