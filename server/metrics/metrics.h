// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"

namespace dhpmap {

/// Counters and timings in the Prometheus text format. Thread-safe.
class Metrics {
 public:
  /// One open map, as it is when the metrics are read.
  struct MapGauges {
    std::string name;
    std::int64_t num_submaps = 0, num_blocks = 0, revision = 0, memory_bytes = 0, num_feeds = 0;
    double behind_s = 0;
  };
  /// How things are when the metrics are read.
  struct Gauges {
    std::vector<MapGauges> maps;
    std::size_t surface_bytes = 0;  ///< of what was made to answer queries, of all maps
    std::size_t num_watchers = 0;
    std::size_t inflight_bytes = 0;  ///< of requests, answers and what only states that are held for them still need
    std::int64_t record_bytes = 0;   ///< of the records of frames, all together
  };

  Metrics();
  ~Metrics();

  void RecordCall(std::string_view method, StatusCode code, double seconds);  ///< dhpmap_rpc_seconds
  void RecordQuery(std::size_t num_points);                                   ///< dhpmap_query_points_total
  void RecordFrame(StatusCode code);                                          ///< dhpmap_ingest_frames_total
  void RecordCommit(StatusCode code, double seconds);                         ///< dhpmap_commit_seconds
  void RecordRefinement(double management_s, double crf_s);                   ///< dhpmap_refinement_seconds

  /// Everything, dhpmap_map_{submaps,blocks,revision,memory_bytes,feeds} of the maps given,
  /// dhpmap_surface_memory_bytes, dhpmap_watchers, dhpmap_inflight_bytes, dhpmap_record_bytes, and what the process
  /// takes: process_resident_memory_bytes, dhpmap_anonymous_memory_bytes, process_threads.
  [[nodiscard]] std::string Text(const Gauges& gauges) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
