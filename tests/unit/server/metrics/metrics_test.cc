// SPDX-License-Identifier: BSD-3-Clause
#include "server/metrics/metrics.h"

#include <gtest/gtest.h>

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
  const std::string text = metrics.Text({{.name = "room", .num_submaps = 4, .num_blocks = 5, .revision = 6}});
  for (const char* line : {"# TYPE dhpmap_rpc_seconds histogram\n",
                           "dhpmap_rpc_seconds_count{code=\"NOT_FOUND\",method=\"MapService/GetMap\"} 2\n",
                           "dhpmap_query_points_total 1000\n", "dhpmap_ingest_frames_total{code=\"OK\"} 1\n",
                           "dhpmap_commit_seconds_count{code=\"OK\"} 1\n",
                           "dhpmap_refinement_seconds_sum{step=\"crf\"} 1.5\n", "dhpmap_map_submaps{map=\"room\"} 4\n",
                           "dhpmap_map_revision{map=\"room\"} 6\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

}  // namespace
}  // namespace dhpmap
