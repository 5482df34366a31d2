// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "tests/rig/clients/frame_feed.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr char kWatchedMap[] = "watched";
constexpr int kReadWatchesPerConnection = 16, kNicenessOfWatchers = 10;
constexpr double kMostSlower_percent = 5;

struct WatchedRun {
  FeedOutcome fed;
  ProcessUse peak;
};

/// The watchers come one after the other; frames are measured once all are there.
bool AwaitWatchers(const ServerUnderTest& server, int num_watchers) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (server.Metric("dhpmap_watchers") < num_watchers) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

/// All frames into a map of a new server; nothing, and said, if anything failed.
std::optional<WatchedRun> FeedWatched(const std::string& dataset, const std::vector<const v1::Frame*>& frames,
                                      int num_watchers) {
  ServerUnderTest server;
  const Status created = CreateMapFor(dataset, kWatchedMap, server.process().Connect());
  if (!created.ok()) return std::printf("FAILED: %s\n", created.ToString().c_str()), std::nullopt;
  const Target target = server.TargetOf(kWatchedMap);
  std::unique_ptr<testing::Process> watchers;
  if (num_watchers > 0) {
    watchers = StartSelf(server.folder(),
                         {"read-watches", target.grpc_address, std::to_string(target.http_port), kWatchedMap,
                          std::to_string(num_watchers)},
                         kNicenessOfWatchers);
  }
  if (!AwaitWatchers(server, num_watchers)) return std::printf("FAILED: not all watch\n"), std::nullopt;
  PeakWatch watch(server.pid());
  const auto mapping = v1::MappingService::NewStub(server.process().Connect());
  const WatchedRun run{.fed = FeedOnce(*mapping, kWatchedMap, "robot", frames), .peak = watch.peak()};
  std::printf("%3d watchers: %d frames, fused in %.2f s, %.2f frames/s, at most %.0f MiB anonymous, %d threads\n",
              num_watchers, run.fed.num_fused, run.fed.fuse_s, run.fed.rate_hz(), run.peak.anonymous_mib,
              run.peak.num_threads);
  bool held = run.fed.status.ok() && run.fed.num_fused == static_cast<int>(frames.size());
  if (!held) std::printf("FAILED: not all frames were fused: %s\n", run.fed.status.error_message().c_str());
  if (watchers != nullptr) {
    watchers->Signal(SIGTERM);
    const bool read = watchers->Wait(60) == 0;
    std::printf("%s%s", watchers->Stdout().c_str(), read ? "" : "FAILED: watches that ended, or were told nothing\n");
    held &= read;
  }
  std::fflush(stdout);
  return held ? std::optional(run) : std::nullopt;
}

/// The upper one of the two in the middle, if there are two.
double UpperMedian(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

bool RunWatchers(const WatchersOptions& options) {
  const auto frames = ReadFrames(options.dataset);
  if (!frames.ok()) return std::printf("FAILED: %s\n", frames.status().ToString().c_str()), false;
  std::vector<const v1::Frame*> all;
  for (const v1::Frame& frame : *frames) all.push_back(&frame);
  std::vector<double> slower_fused_percent, slower_fed_percent, more_mib, more_threads;
  for (int pair = 0; pair < options.num_pairs; ++pair) {
    // In turn the one and the other first, so that a machine that becomes slower is held against neither.
    const bool watched_first = pair % 2 == 1;
    const auto first = FeedWatched(options.dataset, all, watched_first ? options.num_watchers : 0);
    const auto second = FeedWatched(options.dataset, all, watched_first ? 0 : options.num_watchers);
    if (!first || !second) return false;
    const WatchedRun& with = watched_first ? *first : *second;
    const WatchedRun& without = watched_first ? *second : *first;
    slower_fused_percent.push_back(100 * (with.fed.fuse_s / without.fed.fuse_s - 1));
    slower_fed_percent.push_back(100 * (without.fed.rate_hz() / with.fed.rate_hz() - 1));
    more_mib.push_back(with.peak.anonymous_mib - without.peak.anonymous_mib);
    more_threads.push_back(with.peak.num_threads - without.peak.num_threads);
    std::printf(
        "pair %d: with them fusing takes %+.1f %%, a frame from end to end %+.1f %%, %+.0f MiB, %+.0f threads\n", pair,
        slower_fused_percent.back(), slower_fed_percent.back(), more_mib.back(), more_threads.back());
  }
  std::printf("in the median %+.0f MiB anonymous memory, %+.0f threads\n", UpperMedian(more_mib),
              UpperMedian(more_threads));
  bool held = Expect("fusing slower while watched", UpperMedian(slower_fused_percent), kMostSlower_percent, "%");
  held &= Expect("fewer frames a second while watched", UpperMedian(slower_fed_percent), kMostSlower_percent, "%");
  return held;
}

bool RunReadWatches(const Target& target, int num_watches) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  v1::WatchMapRequest request;
  request.set_map("maps/" + target.map_id);
  request.set_start_revision(1);
  std::atomic<bool> is_over = false;
  std::atomic<int> num_changes = 0, num_ended = 0, num_untold = 0;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  {
    std::vector<std::jthread> threads;
    std::shared_ptr<grpc::Channel> channel;
    for (int i = 0; i < num_watches; ++i) {
      if (i % kReadWatchesPerConnection == 0) channel = OwnChannel(target.grpc_address);
      grpc::ClientContext& context = *contexts.emplace_back(std::make_unique<grpc::ClientContext>());
      threads.emplace_back([&, channel] {
        const auto stream = v1::WatchService::NewStub(channel)->WatchMap(&context, request);
        v1::WatchMapResponse told;
        int num_own = 0;
        while (stream->Read(&told)) num_own += told.has_change() ? 1 : 0;
        num_changes += num_own;
        if (!is_over) ++num_ended;
        if (num_own == 0) ++num_untold;
      });
    }
    int signal = 0;
    sigwait(&signals, &signal);
    is_over = true;
    for (const auto& context : contexts) context->TryCancel();
  }
  std::printf("              %d watches were told %d changes, %d ended before, %d were told nothing\n", num_watches,
              num_changes.load(), num_ended.load(), num_untold.load());
  return num_ended == 0 && num_untold == 0;
}

}  // namespace dhpmap::rig
