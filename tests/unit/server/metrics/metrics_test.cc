// SPDX-License-Identifier: BSD-3-Clause
#include "server/metrics/metrics.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <string>

namespace dhpmap {
namespace {

TEST(Metrics, TextHoldsWhatWasRecorded) {
  Metrics metrics;
  metrics.RecordCall("MapService/GetMap", StatusCode::kNotFound, 0.002);
  metrics.RecordCall("MapService/GetMap", StatusCode::kNotFound, 0.2);
  metrics.RecordQuery(1000);
  metrics.RecordFrame(StatusCode::kOk);
  metrics.RecordCommit(StatusCode::kOk, 0.01);
  metrics.RecordRefinement(0.25, 1.5);
  const std::string text = metrics.Text({.maps = {{.name = "room", .num_submaps = 4, .num_blocks = 5, .revision = 6}},
                                         .surface_bytes = 7,
                                         .inflight_bytes = 8});
  for (const char* line :
       {"# TYPE dhpmap_rpc_seconds histogram\n",
        "dhpmap_rpc_seconds_count{code=\"NOT_FOUND\",method=\"MapService/GetMap\"} 2\n",
        "dhpmap_query_points_total 1000\n", "dhpmap_ingest_frames_total{code=\"OK\"} 1\n",
        "dhpmap_commit_seconds_count{code=\"OK\"} 1\n", "dhpmap_refinement_seconds_sum{step=\"crf\"} 1.5\n",
        "dhpmap_map_submaps{map=\"room\"} 4\n", "dhpmap_surface_memory_bytes 7\n", "dhpmap_inflight_bytes 8\n",
        "dhpmap_map_revision{map=\"room\"} 6\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

/// The value of a gauge without labels.
double Gauge(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("\n" + name + " ");
  return at == std::string::npos ? -1 : std::stod(text.substr(at + name.size() + 2));
}

TEST(Metrics, TellsWhatTheProcessTakes) {
  const Metrics metrics;
  const double before = Gauge(metrics.Text({}), "dhpmap_anonymous_memory_bytes");
  // From the kernel, not the allocator: a sanitizer would keep a shadow of what it hands out.
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
