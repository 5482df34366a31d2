// SPDX-License-Identifier: BSD-3-Clause
// A few kills of what dhpmap-rig-kills does hundreds of times.
#include "tests/rig/kills.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/scenes.h"

namespace dhpmap::rig {
namespace {

TEST(Kills, AServerKilledAtAnyMomentKeepsWhatItToldItsClients) {
  const testing::TempDir folder;
  std::ostringstream progress;
  const KillReport report = RunKills({.num_kills = 5,
                                      .min_life_s = 0.2,
                                      .max_life_s = 0.5,
                                      .num_editors = 2,
                                      .num_places = 2,
                                      .lives_of_map = 3,
                                      .directory = folder.path()},
                                     progress);
  EXPECT_TRUE(report.complaints.empty()) << ToText(report);
  EXPECT_EQ(report.num_kills, 5) << ToText(report);
  EXPECT_GT(report.tally.num_edits_made, 0) << ToText(report);
  EXPECT_GT(report.tally.num_resumed, 0) << ToText(report);
  EXPECT_GT(report.tally.num_names, 0) << ToText(report);
}

}  // namespace
}  // namespace dhpmap::rig
