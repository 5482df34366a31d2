// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "tests/rig/ledger/ledger.h"
#include "tests/rig/ledger/phases.h"

namespace dhpmap::rig {

struct KillOptions {
  int num_kills = 300;
  std::uint64_t seed = 1;
  double min_life_s = 0.05, max_life_s = 1.0;  ///< from the moment that clients are let in
  int num_fed_maps = 2;                        ///< each with a client that feeds it
  int num_editors = 3, num_readers = 2;
  int num_list_editors = 2;
  int num_places = 6;     ///< of the corridor that is mapped
  int lives_of_map = 25;  ///< then another is made, of a name that a map before the last had, too
  bool migrates = true;   ///< one kill in six is of a server that brings an older database up to date
  std::filesystem::path directory;
};

struct KillReport {
  int num_kills = 0, num_starts = 0;
  ByPhase<int> num_kills_in;    ///< a server may be at several things when it is killed
  int num_half_migrated = 0;    ///< databases that a kill left half brought up to date
  std::vector<double> start_s;  ///< from starting the process on a database of before to its ready line
  Tally tally;
  Complaints complaints;
};

/// Starts dhpmap-server, lets clients work on it, kills it with SIGKILL at a random moment, starts it again on the same
/// database, and so on, aiming at the phases in turn: at a random moment from when it is seen to be at one on; holds
/// what clients are told against the laws of Ledger, and what is in the backups that were finished, each served by a
/// server of its own. Ends early, with a complaint, if the server does not start or ends by itself, and after many
/// complaints. `progress` hears of each complaint at once.
KillReport RunKills(const KillOptions& options, std::ostream& progress);

/// For people: what was done, what was told, and each complaint.
std::string ToText(const KillReport& report);

}  // namespace dhpmap::rig
