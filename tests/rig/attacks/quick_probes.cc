// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/quick_probes.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <utility>

#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

constexpr std::chrono::milliseconds kBetweenProbes{20};
constexpr std::chrono::seconds kGivenUpAfter{10};
constexpr double kMostProbe_ms = 20;

/// Calls `probe` every 20 ms until stopped.
std::jthread Probe(Latencies& latencies, std::function<bool()> probe) {
  return std::jthread([&latencies, probe = std::move(probe)](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto begin = std::chrono::steady_clock::now();
      if (probe()) latencies.Add(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      else latencies.AddFailure();
      std::this_thread::sleep_until(begin + kBetweenProbes);
    }
  });
}

std::function<bool()> AskForSubmap(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id) {
  const std::shared_ptr<v1::SubmapService::Stub> stub = v1::SubmapService::NewStub(channel);
  return [stub, name = "maps/" + map_id + "/submaps/1"] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kGivenUpAfter);
    v1::GetSubmapRequest request;
    request.set_name(name);
    v1::GetSubmapResponse response;
    return stub->GetSubmap(&context, request, &response).ok();
  };
}

std::function<bool()> AskForHealth(int http_port) {
  const auto client = std::make_shared<http::HttpClient>(http_port);
  return [client] { return client->Ask("GET", "/healthz").status == 200; };
}

}  // namespace

QuickProbes::QuickProbes(const std::shared_ptr<grpc::Channel>& channel, int http_port, const std::string& map_id)
    : submaps_(Probe(get_submap_, AskForSubmap(channel, map_id))), healths_(Probe(health_, AskForHealth(http_port))) {}

void QuickProbes::Stop() {
  for (std::jthread* thread : {&submaps_, &healths_}) thread->request_stop();
  for (std::jthread* thread : {&submaps_, &healths_}) {
    if (thread->joinable()) thread->join();
  }
}

void QuickProbes::Tell() const {
  std::printf("GetSubmap: %s\n/healthz: %s\n", get_submap_.Summary().c_str(), health_.Summary().c_str());
}

bool QuickProbes::Held() const {
  bool held = Expect("GetSubmap p99", 1e3 * get_submap_.Percentile_s(0.99), kMostProbe_ms, "ms");
  held &= Expect("/healthz p99", 1e3 * health_.Percentile_s(0.99), kMostProbe_ms, "ms");
  return held;
}

double QuickProbes::WorstP99_ms() const {
  return 1e3 * std::max(get_submap_.Percentile_s(0.99), health_.Percentile_s(0.99));
}

int QuickProbes::num_failures() const { return get_submap_.num_failures() + health_.num_failures(); }

}  // namespace dhpmap::rig
