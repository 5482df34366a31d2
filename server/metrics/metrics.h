// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"

namespace dhpmap {

/// Counters and timings in the Prometheus text format. Thread-safe.
class Metrics {
 public:
  /// One open map at the time of reading.
  struct MapGauges {
    std::string name;
    std::int64_t num_submaps = 0, num_blocks = 0, revision = 0, memory_bytes = 0, num_feeds = 0;
    double behind_s = 0;
    std::int64_t block_bytes = 0;  ///< part of memory_bytes: blocks, as counted by MemoryKind::kBlocks
  };
  /// Of a server that shares its database with others: its part in the fleet.
  struct FleetGauges {
    std::int64_t num_owned = 0;         ///< maps
    std::int64_t num_taken_over = 0;    ///< maps, since the start, from servers that had died
    std::int64_t num_lost = 0;          ///< maps, since the start, to servers that held this one for dead
    std::int64_t num_failed_beats = 0;  ///< since the start
    std::int64_t num_copies = 0;        ///< of maps that other servers own
    std::int64_t copy_bytes = 0;        ///< memory of the copies
    double copies_behind_s = 0;         ///< since when a copy lacks a known commit
    std::int64_t schema = 0;            ///< of the database
  };
  /// Values at the time of reading.
  struct Gauges {
    std::vector<MapGauges> maps;
    std::optional<FleetGauges> fleet = {};
    std::size_t surface_bytes = 0;  ///< of all surfaces cached for queries
    std::size_t num_watchers = 0;
    std::size_t inflight_bytes = 0;  ///< of requests, answers, and pinned states that only they need
    std::int64_t record_bytes = 0;   ///< of all recorded frames
    std::int64_t store_bytes = 0;    ///< memory of the store
    std::size_t frame_bytes = 0;     ///< of frames that wait to be fused
    // Tiles that are on disk, in the store or in the spill file, until they are needed.
    std::int64_t page_bytes = 0;             ///< of voxels that were paged in and are in memory
    std::uint64_t num_pages_read = 0;        ///< since the start
    std::int64_t page_read_ns = 0;           ///< time for these reads, over all threads
    std::uint64_t num_page_hits = 0;         ///< times that a page was in memory already
    std::int64_t page_held_bytes = 0;        ///< of pages held by running requests
    std::uint64_t num_pages_unreadable = 0;  ///< failed reads
    std::uint64_t num_pages_evicted = 0;     ///< dropped from memory at the limit; still in the store
    std::uint64_t num_spilled = 0;           ///< pages that no store has, written to the spill file
    std::uint64_t num_unspilled = 0;         ///< failed writes
    std::int64_t spill_bytes = 0;            ///< of the spill file
    bool is_insecure = false;                ///< a switch disables protection
    std::int64_t num_audit_dropped = 0;      ///< rows that the audit log in the database lacks
    std::size_t past_bytes = 0;              ///< of stored past states, as far as later ones do not share them
  };

  Metrics();
  ~Metrics();

  void RecordCall(std::string_view method, StatusCode code, double seconds);  ///< dhpmap_rpc_seconds
  void RecordQuery(std::size_t num_points);                                   ///< dhpmap_query_points_total
  void RecordFrame(StatusCode code);                                          ///< dhpmap_ingest_frames_total
  void RecordCommit(StatusCode code, double seconds);                         ///< dhpmap_commit_seconds
  void RecordRefused(std::string_view door, std::string_view why);            ///< dhpmap_guard_refused_total
  void RecordRelayed(StatusCode code);                                        ///< dhpmap_relayed_calls_total
  void RecordRefinement(double management_s, double crf_s);                   ///< dhpmap_refinement_seconds

  /// All metrics: dhpmap_map_{submaps,blocks,revision,memory_bytes,feeds} of the given maps, dhpmap_insecure,
  /// dhpmap_surface_memory_bytes, dhpmap_watchers, dhpmap_inflight_bytes, dhpmap_record_bytes,
  /// dhpmap_page_memory_bytes, dhpmap_pages_{read,unreadable,let_go}_total, dhpmap_audit_dropped_total; in a fleet
  /// dhpmap_fleet_maps, dhpmap_fleet_{takeovers,lost_maps,failed_beats}_total, dhpmap_fleet_copies,
  /// dhpmap_fleet_copy_memory_bytes, dhpmap_fleet_copies_behind_seconds and dhpmap_fleet_schema; and of the process:
  /// process_resident_memory_bytes, dhpmap_anonymous_memory_bytes, process_threads.
  ///
  /// The kernel reports the latter. The program itself counts dhpmap_scratch_bytes and dhpmap_scratch_peak_bytes
  /// (maximum since the start) of kind "refinement", "meshing" and "fusion", and dhpmap_memory_bytes. The latter counts
  /// each byte under one kind, so the sum is the known part of the anonymous memory:
  ///   - maps: blocks of all retained states (shared blocks once), and other memory of published states
  ///   - surfaces: caches for queries, and the buffers of threads that fill them
  ///   - requests: budget taken by requests, answers and waiting frames
  ///   - refinement, meshing, fusion: as dhpmap_scratch_bytes
  ///   - store: SQLite's
  ///   - allocator: its book-keeping, gaps and free memory that it keeps; 0 if it does not report them
  /// Memory of libraries and threads is in no kind: some 20 MiB, also for a server without maps.
  [[nodiscard]] std::string Text(const Gauges& gauges) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
