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
    std::int64_t block_bytes = 0;  ///< of memory_bytes, what MemoryKind::kBlocks counts where it is allocated
  };
  /// How things are when the metrics are read.
  struct Gauges {
    std::vector<MapGauges> maps;
    std::size_t surface_bytes = 0;  ///< of what was made to answer queries, of all maps
    std::size_t num_watchers = 0;
    std::size_t inflight_bytes = 0;  ///< of requests, answers and what only states that are held for them still need
    std::int64_t record_bytes = 0;   ///< of the records of frames, all together
    std::int64_t store_bytes = 0;    ///< that the store has in memory
    std::size_t frame_bytes = 0;     ///< of frames that wait to be fused
    // Tiles of maps that are on the disk, in the store or in the file beside it, until they are needed.
    std::int64_t page_bytes = 0;             ///< of voxels that were, and are still in memory
    std::uint64_t num_pages_read = 0;        ///< since the start
    std::int64_t page_read_ns = 0;           ///< that this took, of all threads
    std::uint64_t num_page_hits = 0;         ///< times that one was in memory already
    std::int64_t page_held_bytes = 0;        ///< of what requests under way have read
    std::uint64_t num_pages_unreadable = 0;  ///< tries to read one that failed
    std::uint64_t num_pages_evicted = 0;     ///< left in the store again, as there were too many
    std::uint64_t num_spilled = 0;           ///< written to the file for what no store has as it is
    std::uint64_t num_unspilled = 0;         ///< tries to write one that failed
    std::int64_t spill_bytes = 0;            ///< of that file
    bool is_insecure = false;                ///< a switch lets strangers in
    std::size_t past_bytes = 0;  ///< of states that were stored last, as far as later ones do not share them
  };

  Metrics();
  ~Metrics();

  void RecordCall(std::string_view method, StatusCode code, double seconds);  ///< dhpmap_rpc_seconds
  void RecordQuery(std::size_t num_points);                                   ///< dhpmap_query_points_total
  void RecordFrame(StatusCode code);                                          ///< dhpmap_ingest_frames_total
  void RecordCommit(StatusCode code, double seconds);                         ///< dhpmap_commit_seconds
  void RecordRefused(std::string_view door, std::string_view why);            ///< dhpmap_guard_refused_total
  void RecordRefinement(double management_s, double crf_s);                   ///< dhpmap_refinement_seconds

  /// Everything, dhpmap_map_{submaps,blocks,revision,memory_bytes,feeds} of the maps given,
  /// dhpmap_insecure, dhpmap_surface_memory_bytes, dhpmap_watchers, dhpmap_inflight_bytes, dhpmap_record_bytes,
  /// dhpmap_page_memory_bytes, dhpmap_pages_{read,unreadable,let_go}_total, and what the process
  /// takes: process_resident_memory_bytes, dhpmap_anonymous_memory_bytes, process_threads.
  ///
  /// Beside these, which the kernel tells, what the program has counted by itself: dhpmap_scratch_bytes, and
  /// dhpmap_scratch_peak_bytes for the most since the start, of kind "refinement", "meshing" and "fusion"; and
  /// dhpmap_memory_bytes, each byte under one kind, so that its sum is what is known of the anonymous memory:
  ///   - maps: blocks of all states that anybody keeps, and what published states have besides; once where clones share
  ///   - surfaces: made for queries, with the rooms in which threads make them
  ///   - requests: room that requests, answers and frames that wait have taken
  ///   - refinement, meshing, fusion: as dhpmap_scratch_bytes
  ///   - store: SQLite's
  ///   - allocator: its book-keeping, gaps and what it keeps for later; 0 where it does not tell
  /// What libraries and threads take is in none of them: some 20 MiB, also of a server without maps.
  [[nodiscard]] std::string Text(const Gauges& gauges) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
