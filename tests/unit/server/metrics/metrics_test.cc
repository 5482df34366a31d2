// SPDX-License-Identifier: BSD-3-Clause
#include "server/metrics/metrics.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <string>

#include "mapping/base/memory_count.h"

namespace dhpmap {
namespace {

TEST(Metrics, TextContainsTheRecordedValues) {
  Metrics metrics;
  metrics.RecordCall("MapService/GetMap", StatusCode::kNotFound, 0.002);
  metrics.RecordCall("MapService/GetMap", StatusCode::kNotFound, 0.2);
  metrics.RecordQuery(1000);
  metrics.RecordFrame(StatusCode::kOk);
  metrics.RecordCommit(StatusCode::kOk, 0.01);
  metrics.RecordRefinement(0.25, 1.5);
  const std::string text = metrics.Text({.maps = {{.name = "room", .num_submaps = 4, .num_blocks = 5, .revision = 6}},
                                         .surface_bytes = 7,
                                         .inflight_bytes = 8,
                                         .page_bytes = 9,
                                         .num_pages_read = 10,
                                         .page_read_ns = 2'500'000'000,
                                         .num_page_hits = 16,
                                         .page_held_bytes = 15,
                                         .num_pages_evicted = 11,
                                         .num_spilled = 12,
                                         .spill_bytes = 14,
                                         .past_bytes = 11});
  for (const char* line : {"# TYPE dhpmap_rpc_seconds histogram\n",
                           "dhpmap_rpc_seconds_count{code=\"NOT_FOUND\",method=\"MapService/GetMap\"} 2\n",
                           "dhpmap_query_points_total 1000\n",
                           "dhpmap_ingest_frames_total{code=\"OK\"} 1\n",
                           "dhpmap_commit_seconds_count{code=\"OK\"} 1\n",
                           "dhpmap_refinement_seconds_sum{step=\"crf\"} 1.5\n",
                           "dhpmap_map_submaps{map=\"room\"} 4\n",
                           "dhpmap_surface_memory_bytes 7\n",
                           "dhpmap_inflight_bytes 8\n",
                           "dhpmap_page_memory_bytes 9\n",
                           "# TYPE dhpmap_pages_read_total counter\n",
                           "dhpmap_pages_read_total 10\n",
                           "dhpmap_page_hits_total 16\n",
                           "# TYPE dhpmap_pages_read_seconds_total counter\n",
                           "dhpmap_pages_read_seconds_total 2.5\n",
                           "dhpmap_page_held_bytes 15\n",
                           "dhpmap_pages_unreadable_total 0\n",
                           "dhpmap_pages_let_go_total 11\n",
                           "dhpmap_pages_spilled_total 12\n",
                           "dhpmap_pages_unspilled_total 0\n",
                           "dhpmap_spill_bytes 14\n",
                           "dhpmap_past_states_memory_bytes 11\n",
                           "dhpmap_map_revision{map=\"room\"} 6\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

TEST(Metrics, OnlyAServerOfAFleetHasMetricsOfTheFleet) {
  const Metrics metrics;
  EXPECT_EQ(metrics.Text({}).find("dhpmap_fleet_"), std::string::npos);
  const std::string text = metrics.Text({.fleet = Metrics::FleetGauges{.num_owned = 3,
                                                                       .num_taken_over = 4,
                                                                       .num_lost = 5,
                                                                       .num_failed_beats = 6,
                                                                       .num_copies = 7,
                                                                       .copy_bytes = 8,
                                                                       .copies_behind_s = 0.5,
                                                                       .schema = 9}});
  for (const char* line :
       {"dhpmap_fleet_maps 3\n", "# TYPE dhpmap_fleet_takeovers_total counter\n", "dhpmap_fleet_takeovers_total 4\n",
        "dhpmap_fleet_lost_maps_total 5\n", "dhpmap_fleet_failed_beats_total 6\n", "dhpmap_fleet_copies 7\n",
        "dhpmap_fleet_copy_memory_bytes 8\n", "dhpmap_fleet_copies_behind_seconds 0.5\n", "dhpmap_fleet_schema 9\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

TEST(Metrics, CountsEachByteUnderOneKind) {
  const Metrics metrics;
  Metrics::Gauges gauges{.maps = {{.name = "room", .memory_bytes = 100, .block_bytes = 40},
                                  {.name = "hall", .memory_bytes = 20, .block_bytes = 10}},
                         .surface_bytes = 7,
                         .inflight_bytes = 80,
                         .store_bytes = 9,
                         .frame_bytes = 2};
  std::string text;
  {
    const CountedBytes blocks(MemoryKind::kBlocks, 65), refinement(MemoryKind::kRefinement, 3);
    const CountedBytes meshing(MemoryKind::kMeshing, 500), fusion(MemoryKind::kFusion, 4);
    const CountedBytes room(MemoryKind::kTileRooms, 1000), reserved(MemoryKind::kReserved, 50);
    text = metrics.Text(gauges);
  }
  for (const char* line : {
           "# TYPE dhpmap_memory_bytes gauge\n",
           "dhpmap_memory_bytes{kind=\"maps\"} 135\n",  // 65 of all states, and 60 + 10 that is not blocks
           "dhpmap_memory_bytes{kind=\"surfaces\"} 1007\n",
           "dhpmap_memory_bytes{kind=\"requests\"} 32\n",  // what meshing counts is not theirs
           "dhpmap_memory_bytes{kind=\"refinement\"} 3\n",
           "dhpmap_memory_bytes{kind=\"meshing\"} 500\n",
           "dhpmap_memory_bytes{kind=\"fusion\"} 4\n",
           "dhpmap_memory_bytes{kind=\"store\"} 9\n",
           "dhpmap_memory_bytes{kind=\"allocator\"} ",
           "dhpmap_scratch_bytes{kind=\"refinement\"} 3\n",
           "dhpmap_scratch_peak_bytes{kind=\"meshing\"} 500\n",
       }) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
  text = metrics.Text(gauges);
  for (const char* line :
       {"dhpmap_scratch_bytes{kind=\"meshing\"} 0\n", "dhpmap_scratch_peak_bytes{kind=\"meshing\"} 500\n",
        "dhpmap_memory_bytes{kind=\"requests\"} 82\n", "dhpmap_memory_bytes{kind=\"meshing\"} 0\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

TEST(Metrics, AReservationAboveTheUseDoesNotUnderflow) {
  const CountedBytes reserved(MemoryKind::kReserved, 50);
  const std::string text =
      Metrics().Text({.maps = {{.name = "room", .memory_bytes = 10, .block_bytes = 40}}, .inflight_bytes = 20});
  EXPECT_NE(text.find("dhpmap_memory_bytes{kind=\"requests\"} 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("dhpmap_memory_bytes{kind=\"maps\"} 0\n"), std::string::npos) << text;
}

/// The value of a gauge without labels.
double Gauge(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("\n" + name + " ");
  return at == std::string::npos ? -1 : std::stod(text.substr(at + name.size() + 2));
}

TEST(Metrics, ReportsTheMemoryOfTheProcess) {
  const Metrics metrics;
  const double before = Gauge(metrics.Text({}), "dhpmap_anonymous_memory_bytes");
  // From the kernel, not the allocator: a sanitizer would add shadow memory.
  constexpr std::size_t kHeld_bytes = 64u << 20;
  void* const held =
      mmap(nullptr, kHeld_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
  ASSERT_NE(held, MAP_FAILED);
  const std::string text = metrics.Text({});
  const double after = Gauge(text, "dhpmap_anonymous_memory_bytes");
  munmap(held, kHeld_bytes);
  EXPECT_GT(before, 0);
  EXPECT_NEAR(after - before, static_cast<double>(kHeld_bytes), 4e6);
  EXPECT_GE(Gauge(text, "process_resident_memory_bytes"), after);
  EXPECT_GE(Gauge(text, "process_threads"), 1);
}

}  // namespace
}  // namespace dhpmap
