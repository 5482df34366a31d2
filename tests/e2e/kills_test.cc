// SPDX-License-Identifier: BSD-3-Clause
// A few kills of what dhpmap-rig-kills does hundreds of times.
#include "tests/rig/kills/kills.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/scenes.h"

namespace dhpmap::rig {
namespace {

/// Five lives, each of some `life_s`.
KillReport KillFive(double life_s) {
  const testing::TempDir folder;
  std::ostringstream progress;
  return RunKills({.num_kills = 5,
                   .min_life_s = life_s,
                   .max_life_s = 2.5 * life_s,
                   .num_editors = 2,
                   .num_places = 2,
                   .lives_of_map = 3,
                   .directory = folder.path()},
                  progress);
}

bool IsTelling(const Tally& tally) { return tally.num_edits_made > 0 && tally.num_resumed > 0 && tally.num_names > 0; }

TEST(Kills, AServerKilledAtAnyMomentKeepsWhatItToldItsClients) {
  KillReport report;
  for (double life_s = 0.2; life_s < 10 && !IsTelling(report.tally); life_s *= 2) {  // for a busy machine
    report = KillFive(life_s);
    ASSERT_TRUE(report.complaints.empty()) << ToText(report);
    EXPECT_EQ(report.num_kills, 5) << ToText(report);
  }
  EXPECT_TRUE(IsTelling(report.tally)) << ToText(report);
}

}  // namespace
}  // namespace dhpmap::rig
