// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <thread>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/rig/attacks/over_maps.h"
#include "tests/rig/attacks/quick_probes.h"
#include "tests/rig/clients/frame_feed.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr char kLoadMap[] = "load";
constexpr int kNicenessOfClients = 10;
constexpr double kMostAckGap_ms = 250;

bool Report(const QuickProbes& probes, const Latencies& ack_gaps, double seconds) {
  probes.Tell();
  std::printf("gaps between acknowledgements in %.0f s: %s\n", seconds, ack_gaps.Summary().c_str());
  bool held = probes.Held();
  held &= Expect("ack gap p99.9", 1e3 * ack_gaps.Percentile_s(0.999), kMostAckGap_ms, "ms");
  held &= Expect("calls or frames that failed", probes.num_failures() + ack_gaps.num_failures(), 0, "");
  return held;
}

}  // namespace

bool RunLoad(const LoadOptions& options) {
  const auto frames = ReadFrames(options.dataset);
  if (!frames.ok()) return std::printf("FAILED: %s\n", frames.status().ToString().c_str()), false;
  ServerUnderTest server;
  if (!server.MapDataset(options.dataset, kLoadMap)) return false;
  const Target target = server.TargetOf(kLoadMap);
  const auto mapping = v1::MappingService::NewStub(server.process().Connect());
  OverMapsWatch over_maps(server);
  Latencies ack_gaps;
  grpc::Status fed;
  std::optional<QuickProbes> probes;
  {
    std::jthread feeder(
        [&](const std::stop_token& stop) { fed = FeedUntil(*mapping, kLoadMap, *frames, 0, stop, ack_gaps); });
    const auto bulk = StartSelf(server.folder(),
                                {"bulk-clients", target.grpc_address, std::to_string(target.http_port), kLoadMap,
                                 std::to_string(options.num_bulk_clients)},
                                kNicenessOfClients);
    probes.emplace(server.process().Connect(), target.http_port, kLoadMap);
    std::this_thread::sleep_for(std::chrono::duration<double>(options.seconds));
    bulk->Signal(SIGTERM);
    (void)bulk->Wait(60);
    probes->Stop();
    std::printf("%s", bulk->Stdout().c_str());
  }
  bool held = Report(*probes, ack_gaps, options.seconds);
  if (!fed.ok()) std::printf("FAILED: the stream of frames ended: %s\n", fed.error_message().c_str()), held = false;
  held &= ExpectBesideMaps(over_maps.most());
  return held;
}

}  // namespace dhpmap::rig
