// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/paper_tables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "clients/evaluator/markdown.h"
#include "clients/evaluator/paper_numbers.h"

namespace dhpmap::evaluator {
namespace {

TEST(PaperNumbers, ArePossibleOnceTheColumnsAreExchangedBack) {
  int num_rows = 0;
  for (const char* preset : {"indoor", "outdoor_lidar"}) {
    for (const char* system : {"panmap", "dhp_no_refine", "dhp"}) {
      const PaperRow* row = FindPaperRow(preset, system);
      ASSERT_NE(row, nullptr);
      EXPECT_LE(*row->pq, std::min(*row->sq, *row->rq)) << preset << ' ' << system;
      ++num_rows;
    }
  }
  EXPECT_EQ(num_rows, 6);
}

TEST(PaperNumbers, HaveAChamferDistanceThatIsTheMean) {
  for (const char* preset : {"indoor", "outdoor_lidar"}) {
    for (const char* system : {"panmap", "kimera", "dhp"}) {
      const PaperRow* row = FindPaperRow(preset, system);
      EXPECT_NEAR(*row->chamfer_l1_m, (*row->accuracy_m + *row->completion_m) / 2, 0.0005) << preset << ' ' << system;
    }
  }
}

TEST(PaperNumbers, LeaveOutWhatThePaperDoes) {
  EXPECT_EQ(FindPaperRow("indoor", "votes"), nullptr);
  EXPECT_FALSE(FindPaperRow("indoor", "kimera")->pq.has_value());
  EXPECT_FALSE(FindPaperRow("indoor", "dhp_no_refine")->f_score_percent.has_value());
}

TEST(MarkdownTable, IsAlignedAndComplete) {
  MarkdownTable table({"name", "x"});
  table.Add({"a", "1.25"});
  table.Add({"longer name"});
  EXPECT_EQ(table.Text(),
            "| name        |    x |\n"
            "|-------------|-----:|\n"
            "| a           | 1.25 |\n"
            "| longer name |      |\n");
}

TEST(RetrievalTable, SetsThePapersTimesBesideOurs) {
  RetrievalTimes times;
  times.scene = PaperScenes()[0];
  times.traversal_s = 0.0123;
  times.find_s = 5e-9;
  times.copy_s = 0.002;
  const std::string table = RetrievalTable({times});
  for (const char* part : {"4099223", "61745", "12.3 (21.0)", "0.000005", "2.00"}) {
    EXPECT_NE(table.find(part), std::string::npos) << part << " in\n" << table;
  }
}

}  // namespace
}  // namespace dhpmap::evaluator
