// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <thread>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "server/app/open_map/lazy_thread.h"
#include "tests/integration/test_server.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr int kFrames = 2;
/// What threads depend on beside the number of maps, such as gRPC's, is there after so many of them.
constexpr int kFewMaps = 20;
/// Of a map that is being closed, one at a time; seldom seen among so few.
constexpr int kClosingThreads = 2;

bool Make(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id) {
  const auto maps = v1::MapService::NewStub(channel);
  grpc::ClientContext context;
  v1::CreateMapResponse created;
  if (!maps->CreateMap(&context, testing::CreateRequest(map_id), &created).ok()) return false;
  return testing::Feed(*v1::MappingService::NewStub(channel), map_id, 0, kFrames).status.ok();
}

/// Every map by ListMaps, page by page; then a submap list and a query of each.
bool ReadAll(const std::shared_ptr<grpc::Channel>& channel, int num_wanted) {
  const auto maps = v1::MapService::NewStub(channel);
  const auto queries = v1::QueryService::NewStub(channel);
  int num_seen = 0;
  v1::ListMapsRequest request;
  do {
    grpc::ClientContext context;
    v1::ListMapsResponse page;
    if (!maps->ListMaps(&context, request, &page).ok()) return false;
    for (const v1::Map& map : page.maps()) {
      grpc::ClientContext query_context;
      v1::QueryPointsResponse answer;
      v1::QueryPointsRequest query = testing::TestQuery(map.name().substr(5));
      if (!queries->QueryPoints(&query_context, query, &answer).ok()) return false;
      ++num_seen;
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return num_seen == num_wanted;
}

double SecondsFor(const std::function<bool()>& work, bool& held) {
  const auto begin = std::chrono::steady_clock::now();
  if (!work()) std::printf("FAILED: a call was refused, or a map is missing\n"), held = false;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

bool RunManyMaps(const ManyMapsOptions& options) {
  ServerUnderTest server({{"DHPMAP_MAPS_IDLE_CLOSE_S", std::to_string(options.idle_close_s)}});
  const auto channel = server.process().Connect();
  bool held = Make(channel, "first");
  const ProcessUse one = UseOf(server.pid());
  int num_maps = 1;
  const auto make = [&](int up_to) {
    for (; num_maps < up_to; ++num_maps) {
      if (!Make(channel, std::string("m").append(std::to_string(num_maps)))) return false;
    }
    return true;
  };
  PeakWatch peak(server.pid());
  (void)SecondsFor([&] { return make(kFewMaps); }, held);
  std::this_thread::sleep_for(4 * LazyThread::kIdle);  // those that stored the maps retire
  peak.Reset();
  (void)SecondsFor([&] { return ReadAll(channel, kFewMaps); }, held);
  const auto until_closed = std::chrono::duration<double>(3 * options.idle_close_s + 5);
  std::this_thread::sleep_for(until_closed);  // closing takes threads, too
  const int threads_few = peak.peak().num_threads;
  peak.Reset();
  const double made_s = SecondsFor([&] { return make(options.num_maps); }, held);
  const int threads_making = peak.peak().num_threads;
  std::this_thread::sleep_for(4 * LazyThread::kIdle);  // those that stored the last maps retire
  peak.Reset();
  const double read_s = SecondsFor([&] { return ReadAll(channel, options.num_maps); }, held);
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
  const double again_s = SecondsFor([&] { return ReadAll(channel, options.num_maps); }, held);
  std::printf("all opened and queried again in %.1f s\n", again_s);
  return held;
}

}  // namespace dhpmap::rig
