// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/rig/clients/frame_feed.h"
#include "tests/rig/load/door_calls.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr char kAsked[] = "doors";
constexpr double kMost_ms = 5;  // p99 of 100 points while mapping at full rate

/// So many clients for so long. Prints what each kind of call took, and what went wrong.
void Ask(const Target& target, const DoorsOptions& options, const char* when, DoorCalls::Table& table) {
  std::vector<std::unique_ptr<DoorCalls>> clients;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < options.num_clients; ++i) {
      DoorCalls& calls = *clients.emplace_back(std::make_unique<DoorCalls>(target, static_cast<unsigned>(i)));
      threads.emplace_back([&](const std::stop_token& stop) { calls.Run(options.rate_hz, table, stop); });
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(options.seconds));
    for (std::jthread& thread : threads) thread.request_stop();
  }
  std::printf("%s, %d clients, %d points a call\n", when, options.num_clients, DoorCalls::kPoints);
  for (std::size_t kind = 0; kind < table.size(); ++kind) {
    std::printf("  %-34s %s\n", DoorCalls::kKinds[kind], table[kind].Summary().c_str());
  }
  for (const auto& client : clients) {
    for (const std::string& complaint : client->complaints()) std::printf("FAILED: %s\n", complaint.c_str());
  }
  std::fflush(stdout);
}

int NumFailures(const DoorCalls::Table& table) {
  int sum = 0;
  for (const Latencies& of_kind : table) sum += of_kind.num_failures();
  return sum;
}

}  // namespace

bool RunDoors(const DoorsOptions& options) {
  const auto frames = ReadFrames(options.dataset);
  if (!frames.ok()) return std::printf("FAILED: %s\n", frames.status().ToString().c_str()), false;
  ServerUnderTest server;
  if (!server.MapDataset(options.dataset, kAsked)) return false;
  const auto mapping = v1::MappingService::NewStub(server.process().Connect());
  DoorCalls::Table at_rest, mapped;
  Ask(server.TargetOf(kAsked), options, "at rest", at_rest);
  Latencies ack_gaps;
  grpc::Status fed;
  {
    std::jthread feeder([&](const std::stop_token& stop) {
      fed = FeedUntil(*mapping, kAsked, *frames, options.frame_rate_hz, stop, ack_gaps);
    });
    Ask(server.TargetOf(kAsked), options, "while mapping", mapped);
  }
  std::printf("  %-34s %s\n", "gaps of acknowledgements", ack_gaps.Summary().c_str());
  bool held = Expect("calls and frames that failed",
                     NumFailures(at_rest) + NumFailures(mapped) + ack_gaps.num_failures(), 0, "");
  if (!fed.ok()) std::printf("FAILED: the stream of frames ended: %s\n", fed.error_message().c_str()), held = false;
  for (std::size_t kind = 0; kind < mapped.size(); ++kind) {
    held &= Expect(std::string(DoorCalls::kKinds[kind]) + " p99, while mapping", 1e3 * mapped[kind].Percentile_s(0.99),
                   kMost_ms, "ms");
  }
  return held;
}

}  // namespace dhpmap::rig
