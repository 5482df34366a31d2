// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr double kMostAfter_mib = 250, kMostOverMap_mib = 300, kMostGaugeError_percent = 20;

bool Clone(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id) {
  grpc::ClientContext context;
  v1::CloneSubmapRequest request;
  request.set_name("maps/" + map_id + "/submaps/1");
  v1::CloneSubmapResponse response;
  return v1::SubmapService::NewStub(channel)->CloneSubmap(&context, request, &response).ok();
}

bool Finish(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id) {
  grpc::ClientContext context;
  v1::FinishMappingRequest request;
  request.set_map("maps/" + map_id);
  v1::FinishMappingResponse response;
  return v1::MappingService::NewStub(channel)->FinishMapping(&context, request, &response).ok();
}

bool Delete(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id) {
  grpc::ClientContext context;
  v1::DeleteMapRequest request;
  request.set_name("maps/" + map_id);
  v1::DeleteMapResponse response;
  return v1::MapService::NewStub(channel)->DeleteMap(&context, request, &response).ok();
}

}  // namespace

bool RunApartments(const ApartmentsOptions& options) {
  ServerUnderTest server;
  const auto channel = server.process().Connect();
  PeakWatch watch(server.pid());
  bool held = true;
  double most_over_map_mib = 0, most_gauge_error_percent = 0;
  for (int i = 0; i < options.repetitions; ++i) {
    const std::string map_id = "apartment" + std::to_string(i);
    const double before_mib = UseOf(server.pid()).anonymous_mib;
    watch.Reset();
    if (!server.MapDataset(options.dataset, map_id, {"--no-finish"})) return false;
    const double mapping_mib = watch.peak().anonymous_mib;
    watch.Reset();
    if (!Finish(channel, map_id)) return false;
    const double map_mib = server.Metric("dhpmap_map_memory_bytes") / (1 << 20);
    most_over_map_mib = std::max(most_over_map_mib, watch.peak().anonymous_mib - before_mib - map_mib);
    const double gauge_mib = server.Metric("dhpmap_anonymous_memory_bytes") / (1 << 20);
    most_gauge_error_percent =
        std::max(most_gauge_error_percent, 100 * std::abs(gauge_mib / UseOf(server.pid()).anonymous_mib - 1));
    BulkCalls calls(server.TargetOf(map_id));
    if (!calls.ManyPoints(500'000) || !Clone(channel, map_id) || !calls.WholeMesh() || !Delete(channel, map_id)) {
      std::printf("FAILED: a call on %s\n", map_id.c_str());
      held = false;
    }
    if (i % 5 == 0) {
      std::printf("%d: map %.0f MiB, mapping at most %.0f, then %.0f, deleted %.0f\n", i, map_mib, mapping_mib,
                  watch.peak().anonymous_mib, UseOf(server.pid()).anonymous_mib);
      std::fflush(stdout);
    }
  }
  std::this_thread::sleep_for(std::chrono::seconds(15));
  held &= Expect("anonymous memory at the end", UseOf(server.pid()).anonymous_mib, kMostAfter_mib, "MiB");
  held &= Expect("FinishMapping, over the map", most_over_map_mib, kMostOverMap_mib, "MiB");
  held &= Expect("the gauge of anonymous memory is off by", most_gauge_error_percent, kMostGaugeError_percent, "%");
  return held;
}

}  // namespace dhpmap::rig
