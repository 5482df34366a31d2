// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "clients/cpp/calls/pages.h"
#include "server/app/open_map/lazy_thread.h"
#include "tests/integration/test_server.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"
#include "tests/support/client.h"

namespace dhpmap::rig {
namespace {

constexpr int kFrames = 2;
/// What threads depend on beside the number of maps, such as gRPC's, is there after so many of them.
constexpr int kFewMaps = 20;
/// Of a map that is being closed, one at a time; seldom seen among so few.
constexpr int kClosingThreads = 2;

bool Make(const testing::Client& calls, const std::string& map_id) {
  return calls.Call(&testing::MapStub::CreateMap, testing::CreateRequest(map_id)).ok() &&
         testing::Feed(*v1::MappingService::NewStub(calls.channel()), map_id, 0, kFrames).status.ok();
}

/// Every map by ListMaps, page by page; then a query of each.
bool ReadAll(const testing::Client& calls, int num_wanted) {
  int num_seen = 0;
  const auto ask_all = [&](const v1::ListMapsResponse& page) {
    num_seen += static_cast<int>(std::count_if(page.maps().begin(), page.maps().end(), [&](const v1::Map& map) {
      return calls.Call(&testing::QueryStub::QueryPoints, testing::TestQuery(map.name().substr(5))).ok();
    }));
    return true;
  };
  const auto caller = client::Caller::Over(calls.channel());
  return client::ForEachPage(*caller, &testing::MapStub::ListMaps, v1::ListMapsRequest(), ask_all, client::Again::kNo)
             .ok() &&
         num_seen == num_wanted;
}

double SecondsFor(const std::function<bool()>& work, bool& held) {
  const auto begin = std::chrono::steady_clock::now();
  if (!work()) std::printf("FAILED: a call was refused, or a map is missing\n"), held = false;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

bool RunManyMaps(const ManyMapsOptions& options) {
  ServerUnderTest server({{"DHPMAP_MAPS_IDLE_CLOSE_S", std::to_string(options.idle_close_s)}});
  const testing::Client client(server.process().Connect());
  bool held = Make(client, "first");
  const ProcessUse one = UseOf(server.pid());
  int num_maps = 1;
  const auto make = [&](int up_to) {
    for (; num_maps < up_to; ++num_maps) {
      if (!Make(client, std::string("m").append(std::to_string(num_maps)))) return false;
    }
    return true;
  };
  PeakWatch peak(server.pid());
  (void)SecondsFor([&] { return make(kFewMaps); }, held);
  std::this_thread::sleep_for(4 * LazyThread::kIdle);  // those that stored the maps retire
  peak.Reset();
  (void)SecondsFor([&] { return ReadAll(client, kFewMaps); }, held);
  const auto until_closed = std::chrono::duration<double>(3 * options.idle_close_s + 5);
  std::this_thread::sleep_for(until_closed);  // closing takes threads, too
  const int threads_few = peak.peak().num_threads;
  peak.Reset();
  const double made_s = SecondsFor([&] { return make(options.num_maps); }, held);
  const int threads_making = peak.peak().num_threads;
  std::this_thread::sleep_for(4 * LazyThread::kIdle);  // those that stored the last maps retire
  peak.Reset();
  const double read_s = SecondsFor([&] { return ReadAll(client, options.num_maps); }, held);
  std::printf(
      "%d maps made in %.1f s, listed and queried in %.1f s; one map: %d threads, %.0f MiB anonymous; at most %.0f\n",
      options.num_maps, made_s, read_s, one.num_threads, one.anonymous_mib, peak.peak().anonymous_mib);
  std::printf("threads: %d with one map, at most %d with %d, at most %d while maps were made\n", one.num_threads,
              threads_few, kFewMaps, threads_making);
  held &= Expect("threads while all maps were listed and queried", peak.peak().num_threads,
                 threads_few + kClosingThreads, "");
  std::this_thread::sleep_for(until_closed);
  const ProcessUse after = UseOf(server.pid());
  held &= Expect("threads after the idle time", after.num_threads, threads_few, "");
  held &= Expect("anonymous memory after the idle time", after.anonymous_mib, one.anonymous_mib + 50, "MiB");
  const double again_s = SecondsFor([&] { return ReadAll(client, options.num_maps); }, held);
  std::printf("all opened and queried again in %.1f s\n", again_s);
  return held;
}

}  // namespace dhpmap::rig
